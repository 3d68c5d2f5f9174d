#ifndef PASSES_ENVIRONMENT_HEMISPHERES_HEMISPHERE_MOMENTS_H
#define PASSES_ENVIRONMENT_HEMISPHERES_HEMISPHERE_MOMENTS_H

#include "passes/environment/hemispheres/means.h"

/// Adds the passes that integrate an environment's light over the hemisphere of every normal, with
/// all polynomials of the direction up to degree 3: a retained RGBA32_FLOAT image of
/// HEMISPHERE_MOMENT_LAYERS layers, about 240 KB, in the environment's own space and without its
/// intensity. shaders/interface/environment/hemisphere_moments.h says what it holds,
/// shaders/lib/light/hemisphere_moments.glsl looks it up. What a surface reflects towards a viewer
/// is linear in these numbers if its reflectance times cosine is <n, i> times such a polynomial, as
/// that of rough surfaces nearly is. A graph can hold one of them.
///
/// Sums means over texels of 3 degrees: off by at most 3e-3 of the irradiance of a single light,
/// and exact for light that is the same everywhere.
lobe_resource passes_hemisphere_moments(lobe_graph *graph, const environment_means *means);

#endif
