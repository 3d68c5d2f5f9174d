#ifndef INTERFACE_SLOPE_MOMENTS_H
#define INTERFACE_SLOPE_MOMENTS_H

#include "specialisation.h"
#include "types.h"

// Layers of a map of slope moments (see shaders/maps/slope_moments.comp). A slope is that of the
// surface perpendicular to a normal, (x, y) = -n_xy/n_z. E: mean over texels.
//
// [0]  E[x], E[y], E[n_z], mean variance of the base lobes in slopes
// [1]  E[x^2], E[y^2], E[xy], E[1]
//
// x and y are those of the base lobes' directions, n_z is the normals'. E[1] is how much the texels
// count: one, or less under a mask (maps/base_maps.glsl).
#define SLOPE_LAYER_FIRST  0
#define SLOPE_LAYER_SECOND 1
#define SLOPE_LAYERS       2

// Steepest slope that is stored: the tangent of 83 degrees. Directions nearer to the horizon, or
// below it, are clamped to it: their slopes tend to infinity, and every mean that includes them
// would too.
#define SLOPE_MAXIMUM 8.0

// uint, [0, 2], of `leadr`: 3, 5 or 7 slopes along each axis of a grid
#define SPECIALISE_GRID (SPECIALISE_FILTER + 10)
// uint, BASE_PLANE_..., of `leadr`: over which plane the base lobes' covariance is added
#define SPECIALISE_BASE_PLANE (SPECIALISE_FILTER + 11)

#define BASE_PLANE_FACETS  0 // the plane of the mean normal
#define BASE_PLANE_SURFACE 1 // the surface's, and GGX without its tails, as in the paper

// The map of microfacets' base lobes of `leadr`, `multi_leadr` and `displaced` (shaders/filters/
// leadr/base_lobes.comp) has one layer: with alpha their width and w the luminance of F0,
//   E[w alpha], E[w alpha^2], E[w].

// uint, BASE_LOBES_...
#define SPECIALISE_BASE_LOBES (SPECIALISE_FILTER + 12)

#define BASE_LOBES_ALIKE    0 // there is no such map
#define BASE_LOBES_VARY     1 // in width; w is one, or metal has one colour
#define BASE_LOBES_COLOURED 2 // the base colour map lies on the surface as the widths do

// Numbers of the knobs of `leadr` (see knobs.h).
struct leadr_knobs {
    float height; // factor of all slopes
    float padding_0;
    float padding_1;
    float padding_2;
};
INTERFACE_SIZE(leadr_knobs, 16)

#endif
