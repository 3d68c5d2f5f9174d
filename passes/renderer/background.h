#ifndef PASSES_RENDERER_BACKGROUND_H
#define PASSES_RENDERER_BACKGROUND_H

#include "passes/context/filter.h"
#include "passes/environment/light.h"

/// Adds a draw of the scene's environment to a raster pass, before those of the scene. `cube`: the
/// environment's radiance with all its levels. `aov`: with arbitrary output variables. `form`: its
/// depth test and indirect counts; the rest is zero. Without supersampling, each sample shows the
/// mean over the part of the environment that it stands for.
void passes_background(lobe_pass *pass, const filter_context *context, lobe_resource cube,
                       const shading_sample *sample, bool aov, const lobe_draw *form);

#endif
