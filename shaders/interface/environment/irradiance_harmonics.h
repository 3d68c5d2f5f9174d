#ifndef INTERFACE_IRRADIANCE_HARMONICS_H
#define INTERFACE_IRRADIANCE_HARMONICS_H

#include "../types.h"

// Spherical harmonics of degree l and order m, l <= 2, |m| <= l: number l (l + 1) + m.
#define HARMONICS 9

// Texels along the map of what nine harmonics miss (lib/light/octahedron.glsl), without the border
// of one texel around it: as many as those of hemisphere_moments.h, for the same reason. By normal,
// RGB: irradiance less its harmonics, zero where harmonics are windowed; w: of the light near the
// normal's horizon, the share that comes from below it.
#define HARMONICS_REMAINDER_SIZE  32
#define HARMONICS_REMAINDER_WIDTH 34

// Light counts as near a horizon by 1 - |s|/0.8, s the sine of its height. The width of what
// slopes of 0.3 to 0.6 root mean square hide or see (found in four environments and the sky).
#define HARMONICS_HORIZON_SINE 0.8f

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

// Push constants of irradiance_remainder.
struct irradiance_remainder_constants {
    uint size;    // texels along a face's edge
    uint is_zero; // leave no remainder of irradiance
};
INTERFACE_SIZE(irradiance_remainder_constants, 8)

#endif
