#ifndef INTERFACE_BROAD_REFLECTION_H
#define INTERFACE_BROAD_REFLECTION_H

#include "../types.h"

// What rough microfacets reflect, as a lobe and, for the part of F_0 and that of F_90 each, a sum
// of ten functions of the incoming direction in the plane of reflection: x towards the viewer's
// side, z along the normal. Each is z, the cosine of incidence, times
//   1, z, z^2, z^3;  x, x z, x z^2;  x^2 - y^2, (x^2 - y^2) z;  x^3 - 3 x y^2,
// by order m of their dependence on the azimuth, cos(m azimuth).
#define BROAD_FUNCTIONS 10
#define BROAD_ORDERS    4

// The table: columns are the square root of the cosine to the viewer, from 0 in the first texel's
// centre to 1 in the last one's; rows are roughness, from BROAD_LEAST_ROUGHNESS to 1. Layers 0 to 2
// hold the coefficients and then the lobe's weight for F_0, layers 3 to 5 those for F_90, each for
// an albedo of 1.
#define BROAD_REFLECTION_SIZE   32
#define BROAD_REFLECTION_LAYERS 6
// Smoother surfaces reflect a sum of lobes (interface/environment/reflected_lobes.h); from
// BROAD_FULL_ROUGHNESS on, what is said here.
#define BROAD_LEAST_ROUGHNESS 0.6f
#define BROAD_FULL_ROUGHNESS  0.7f
// Of dielectrics nothing is found in this way, from BROAD_FULL_F0 on all.
#define BROAD_LEAST_F0 0.05f
#define BROAD_FULL_F0  0.1f

// Spherical harmonics up to this degree, of orders 0 to 3 in cos(m azimuth), by order and degree:
// their least squares determine the coefficients.
#define BROAD_DEGREE    8
#define BROAD_HARMONICS 30 // 9 + 8 + 7 + 6

// What the pass needs to know of them (storage buffer, std430). The functions of one order are
// combinations of the harmonics of that order only.
struct broad_harmonics {
    float scale[32]; // of each harmonic, with its weight
    // For each function twelve numbers: what the harmonics of its order contribute to its
    // coefficient, and its own harmonics.
    float coefficient[120];
    float harmonic[120];
};
INTERFACE_SIZE(broad_harmonics, 1088)

#endif
