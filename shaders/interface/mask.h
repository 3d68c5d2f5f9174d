#ifndef INTERFACE_MASK_H
#define INTERFACE_MASK_H

#include "types.h"

// Push constants of mask_coverage.
struct mask_constants {
    uint width; // of the base colour map, texels
    uint height;
    uint interpolated; // 1: the map is read with linear interpolation, 0: the nearest texel
    float alpha;       // factor of the map's alpha
    float cutoff;      // what is below is cut away
};
INTERFACE_SIZE(mask_constants, 20)
INTERFACE_OFFSET(mask_constants, height, 4)
INTERFACE_OFFSET(mask_constants, interpolated, 8)
INTERFACE_OFFSET(mask_constants, alpha, 12)
INTERFACE_OFFSET(mask_constants, cutoff, 16)

#endif
