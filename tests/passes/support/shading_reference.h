#ifndef TESTS_PASSES_SUPPORT_SHADING_REFERENCE_H
#define TESTS_PASSES_SUPPORT_SHADING_REFERENCE_H

#include <lobe/scene.h>

#include "tests/reference/mixture/layers.h"

/// What the shading pass computes for one light, in double precision. Directions are of unit
/// length, in the tangent frame; results are radiance for an irradiance of one perpendicular to
/// the light, red, green and blue.

/// The base material without maps, about the normal of one texel.
void shade_base_material(const lobe_material *material, const double normal[3],
                         const double outgoing[3], const double incoming[3], double radiance[3]);

/// Knobs of Algorithm 1.
typedef struct refinement_knobs {
    uint32_t subdivision;
    bool dispersion;
    double epsilon0, epsilon1, blend;
} refinement_knobs;

/// The filter "lobes" at one texel of a mixture in tangent space, without level 0's share.
/// `count` (may be NULL) receives how many lobes were evaluated.
void shade_mixture(const lobe_material *material, const refinement_knobs *knobs,
                   const reference_layers *mixture, uint32_t x, uint32_t y,
                   const double outgoing[3], const double incoming[3], double radiance[3],
                   unsigned *count);

/// Half vector of two unit directions that are not opposite.
void half_between(const double a[3], const double b[3], double half_vector[3]);

#endif
