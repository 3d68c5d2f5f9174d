#ifndef INTERFACE_MASK_H
#define INTERFACE_MASK_H

#include "../types.h"

// Push constants of mask_coverage.
struct mask_constants {
    uint width; // of the base colour map, texels
    uint height;
    uint interpolated; // 1: the map is read with linear interpolation, 0: the nearest texel
    uint repeats_u;    // 1: beyond its edge the map begins again, 0: it is mirrored or goes on
    uint repeats_v;
    float alpha;  // factor of the map's alpha
    float cutoff; // what is below is cut away
};
INTERFACE_SIZE(mask_constants, 28)
INTERFACE_OFFSET(mask_constants, height, 4)
INTERFACE_OFFSET(mask_constants, interpolated, 8)
INTERFACE_OFFSET(mask_constants, repeats_u, 12)
INTERFACE_OFFSET(mask_constants, repeats_v, 16)
INTERFACE_OFFSET(mask_constants, alpha, 20)
INTERFACE_OFFSET(mask_constants, cutoff, 24)

#endif
