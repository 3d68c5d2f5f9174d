#ifndef PASSES_RENDERER_BACKGROUND_H
#define PASSES_RENDERER_BACKGROUND_H

#include "passes/context/filter.h"

/// Adds a draw of the scene's environment to a raster pass; it must be the first draw. `cube`: the
/// environment's radiance with all its levels. `sample`: position in the pixel, [0, 1] each.
/// `aov`: with arbitrary output variables. Without supersampling, each pixel shows the mean over
/// the part of the environment that it covers.
void passes_background(lobe_pass *pass, const filter_context *context, lobe_resource cube,
                       const float sample[2], bool aov);

#endif
