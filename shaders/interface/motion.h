#ifndef INTERFACE_MOTION_H
#define INTERFACE_MOTION_H

#include "types.h"

// Constants of the passes that draw motion (uniform block, std140).
struct motion_constants {
    float4x4 world_to_clip; // as in frame_constants: where the picture is drawn
    float4x4 current;       // the same without jitter
    float4x4 change;        // of the previous frame, without jitter, less `current`
    float4 half_extent;     // x, y: of the picture, pixels
};
INTERFACE_SIZE(motion_constants, 208)
INTERFACE_OFFSET(motion_constants, current, 64)
INTERFACE_OFFSET(motion_constants, change, 128)
INTERFACE_OFFSET(motion_constants, half_extent, 192)

// Directions of the picture's pixels in the world (push constants of the background): centre + x
// right + y down at a position in clip space, not normalised.
struct motion_background_constants {
    float4 centre;
    float4 right;
    float4 down;
};
INTERFACE_SIZE(motion_background_constants, 48)

// Motion is clamped to this number of pixels to either side; a power of two that half precision
// holds.
#define MOTION_LIMIT 32768

#endif
