#ifndef PASSES_RENDERER_SAMPLES_SAMPLES_H
#define PASSES_RENDERER_SAMPLES_SAMPLES_H

#include "passes/renderer/shading.h"

/// Whether the frame's pixels may take more than one filtered sample (knob `samples`), or their
/// number is shown (`view`). If not, passes_shading draws the picture alone.
bool passes_samples_several(const filter_context *context);

/// Adds the passes that draw the picture with as many samples per pixel as each needs, into the
/// targets' radiance. Depth and output variables are those of the first sample, at the pixel's
/// centre.
void passes_samples(const filter_context *context, const draw_list *draws,
                    const shading_light *light, shading_targets *targets);

#endif
