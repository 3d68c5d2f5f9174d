#ifndef SCENES_ANIMATION_CHANNEL_H
#define SCENES_ANIMATION_CHANNEL_H

#include <lobe/animation.h>

/// The value of a channel at a time: `width` numbers. Before the first key and after the last it is
/// that key's. glTF 2.0, appendix C.
void scenes_channel_evaluate(const lobe_animation_channel *channel, double seconds, double *values);

#endif
