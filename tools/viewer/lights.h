#ifndef TOOLS_VIEWER_LIGHTS_H
#define TOOLS_VIEWER_LIGHTS_H

#include <lobe/result.h>

struct viewer;

/// Takes over the lights of a scene that has just been opened. Errors: LOBE_ERROR_OUT_OF_MEMORY,
/// after which the panel shows none.
lobe_result viewer_lights_open(struct viewer *v);
void viewer_lights_close(struct viewer *v);

/// Declares the lights' section of the panel. Changes take effect at once.
void viewer_lights_panel(struct viewer *v);

#endif
