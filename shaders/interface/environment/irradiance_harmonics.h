#ifndef INTERFACE_IRRADIANCE_HARMONICS_H
#define INTERFACE_IRRADIANCE_HARMONICS_H

#include "../types.h"

// Spherical harmonics of degree l and order m, l <= 2, |m| <= l: number l (l + 1) + m.
#define HARMONICS 9

// Irradiance from all directions, as harmonics; the shading pass reads this buffer directly.
struct irradiance_harmonics {
    float4 coefficients[HARMONICS]; // RGB, W/m^2 where the radiance is W/(m^2 sr); w: 0
};
INTERFACE_SIZE(irradiance_harmonics, 144)

// Texels that one group of the first step adds up, and invocations of a group.
#define HARMONICS_GROUP_TEXELS 1024
#define HARMONICS_GROUP_SIZE   64

// Push constants of irradiance_harmonics.
struct irradiance_harmonics_constants {
    uint size; // texels along a face's edge
};
INTERFACE_SIZE(irradiance_harmonics_constants, 4)

// Push constants of irradiance_harmonics_sum.
struct irradiance_harmonics_sum_constants {
    float4 band_factors; // factors of radiance of degree 0, 1, 2; w: 0
    uint count;          // groups of the first step
    uint padding_0;
    uint padding_1;
    uint padding_2;
};
INTERFACE_SIZE(irradiance_harmonics_sum_constants, 32)
INTERFACE_OFFSET(irradiance_harmonics_sum_constants, count, 16)

#endif
