#ifndef INTERFACE_INSTANCE_H
#define INTERFACE_INSTANCE_H

#include "types.h"

// An affine object-to-world transform.
struct instance_constants {
    float4 rows[3]; // each: three of the linear part, then the translation
};
INTERFACE_SIZE(instance_constants, 48)

// Push constants of a draw of instances.
struct draw_constants {
    uint first_instance; // index of its transform; those of the others follow
    float map_width;     // of the height map, the object's lengths, if slopes follow its stretching
};
INTERFACE_SIZE(draw_constants, 8)
INTERFACE_OFFSET(draw_constants, map_width, 4)

#endif
