#ifndef INTERFACE_INSTANCE_H
#define INTERFACE_INSTANCE_H

#include "types.h"

// Push constants of a draw: an affine object-to-world transform.
struct instance_constants {
    float4 rows[3]; // each: three of the linear part, then the translation
};
INTERFACE_SIZE(instance_constants, 48)

#endif
