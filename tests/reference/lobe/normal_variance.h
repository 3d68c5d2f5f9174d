#ifndef TESTS_REFERENCE_LOBE_NORMAL_VARIANCE_H
#define TESTS_REFERENCE_LOBE_NORMAL_VARIANCE_H

#include <lobe/scene.h>

/// Lobes about normals that vary, in double precision; see shaders/lib/lobe/normal_variance.glsl.

/// Of normals whose mean has this length, (0, 1].
double reference_variance_of_mean_normal(double mean_length);

/// A lobe's parameter (tests/reference/lobe/base_lobe.h) about normals of a variance.
double reference_widened_parameter(lobe_distribution distribution, double parameter,
                                   double variance);

#endif
