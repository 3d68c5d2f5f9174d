#ifndef PASSES_RENDERER_BACKGROUND_H
#define PASSES_RENDERER_BACKGROUND_H

#include "passes/filters/filter.h"

/// Adds a draw of the scene's environment to a raster pass that has a picture of `width` x `height`
/// pixels and depth: to be drawn first. `cube`: the environment's radiance with all its levels.
/// `sample`: where in the pixel the sample lies, [0, 1] each. `outputs`: with arbitrary output
/// variables. Where pixels are not supersampled, each shows the mean over as much of the
/// environment as it covers.
void passes_background(lobe_pass *pass, const filter_context *context, lobe_resource cube,
                       const float sample[2], bool outputs);

#endif
