#ifndef INTERFACE_SHADOW_H
#define INTERFACE_SHADOW_H

#include "types.h"

// What a light sees through one layer of the shadow maps (std430): of a directional light and of a
// narrow spot the only one, else one of six, in the order +x, -x, +y, -y, +z, -z.
struct shadow_view {
    float4x4 world_to_clip; // reversed depth; clip space as in lobe/graph.h
    // Depths are equal up to x + y depth; across clip space they change by at most z + w depth.
    float4 tolerance;
};
INTERFACE_SIZE(shadow_view, 80)
INTERFACE_OFFSET(shadow_view, tolerance, 64)

#endif
