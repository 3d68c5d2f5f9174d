#ifndef INTERFACE_BACKGROUND_H
#define INTERFACE_BACKGROUND_H

#include "types.h"

// How the picture's pixels look at the environment (push constants): the direction of a place in
// clip space is centre + x right + y down, in the environment's space, of any length.
struct background_constants {
    float4 centre; // w: factor of the radiance
    float4 right;  // w: steradians of a pixel in the middle; 0: texels are shown as they are
    float4 down;
};
INTERFACE_SIZE(background_constants, 48)

#endif
