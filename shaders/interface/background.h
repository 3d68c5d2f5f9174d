#ifndef INTERFACE_BACKGROUND_H
#define INTERFACE_BACKGROUND_H

#include "types.h"

// Directions of the picture's pixels (push constants): the direction at a position in clip space is
// centre + x right + y down, in the environment's space, not normalised.
struct background_constants {
    float4 centre; // w: factor of the radiance
    float4 right;  // w: solid angle of the middle pixel; 0: texels are shown unfiltered
    float4 down;
};
INTERFACE_SIZE(background_constants, 48)

#endif
