#ifndef TESTS_PASSES_SUPPORT_SLOPE_SHADING_REFERENCE_H
#define TESTS_PASSES_SUPPORT_SLOPE_SHADING_REFERENCE_H

#include <stdbool.h>

#include <lobe/scene.h>

/// What the filters that shade from slope moments compute for one light, in double precision.
/// Directions are of unit length, in the tangent frame; results are radiance for an irradiance of
/// one perpendicular to the light. `moments`: a texel of the map, layer after layer
/// (shaders/interface/slope_moments.h). The material is one without colour or width maps.

void shade_lean(const lobe_material *material, const double moments[8], const double outgoing[3],
                const double incoming[3], double radiance[3]);

/// Knobs of LEADR.
typedef struct leadr_knobs {
    int grid;      ///< slopes each way
    double reach;  ///< of the grid, standard deviations
    double height; ///< factor of all slopes
    bool flat;     ///< base lobes are added over the surface's plane
} leadr_knobs;

void shade_leadr(const lobe_material *material, const leadr_knobs *knobs, const double moments[8],
                 const double outgoing[3], const double incoming[3], double radiance[3]);

/// A Gaussian of a mixture of slopes. All parts together are one.
typedef struct slope_component {
    double part, moments[8];
} slope_component;

/// 1 + Lambda of a displaced surface with such facets, for a direction above its mean plane.
double multi_leadr_area_ratio(const slope_component *components, int count,
                              const double direction[3]);

/// The filter "multi_leadr", of height 1.
void shade_multi_leadr(const lobe_material *material, const leadr_knobs *knobs,
                       const slope_component *components, int count, const double outgoing[3],
                       const double incoming[3], double radiance[3]);

#endif
