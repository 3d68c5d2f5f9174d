#ifndef INTERFACE_ENVIRONMENT_LIGHT_H
#define INTERFACE_ENVIRONMENT_LIGHT_H

#include "../specialisation.h"
#include "../types.h"

// Light from an environment (uniform block, std140). Its maps are in its own space.
struct environment_constants {
    float4 environment_from_world[3]; // rows of a rotation
    float intensity;                  // factor of the maps' radiance
    uint sample_number;               // reference: index of the pixel's sample
    uint pattern;                     // reference: which sample pattern
    uint padding;
};
INTERFACE_SIZE(environment_constants, 64)
INTERFACE_OFFSET(environment_constants, intensity, 48)
INTERFACE_OFFSET(environment_constants, sample_number, 52)
INTERFACE_OFFSET(environment_constants, pattern, 56)

// uint, how the environment is integrated.
#define SPECIALISE_ENVIRONMENT_METHOD SPECIALISE(20)
// uint, [1, 8]: most round lobes that approximate an elongated one.
#define SPECIALISE_ENVIRONMENT_PROBES SPECIALISE(21)
// uint, [2, 8]: samples along each side of the grid of ENVIRONMENT_SAMPLED.
#define SPECIALISE_ENVIRONMENT_GRID SPECIALISE(22)
// uint, HORIZON_...: treatment of the part of a lobe below the surface.
#define SPECIALISE_HORIZON SPECIALISE(23)
// bool: von Mises-Fisher lobes are blends of two cubes instead of two levels.
#define SPECIALISE_ENVIRONMENT_BLENDED SPECIALISE(28)
// bool: light that microfacets reflect more than once is compensated for.
#define SPECIALISE_MULTIPLE_SCATTERING SPECIALISE(27)
// uint, bits of the material: how prefiltered light of its microfacets is found, beside a lobe.
#define SPECIALISE_BROAD_REFLECTION SPECIALISE(39)

#define REFLECTED_AS_LOBES      1 // as a sum of lobes
#define REFLECTED_AS_POLYNOMIAL 2 // as a lobe and a polynomial over the hemisphere

#define ENVIRONMENT_EXACT       0
#define ENVIRONMENT_MIP         1
#define ENVIRONMENT_PREFILTERED 2
#define ENVIRONMENT_SAMPLED     3
#define ENVIRONMENT_REFERENCE   4 // one unbiased sample, for pictures that average many

#define HORIZON_IGNORED 0
#define HORIZON_CLIPPED 1
#define HORIZON_FADED   2

#endif
