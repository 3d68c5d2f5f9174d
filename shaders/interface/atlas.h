#ifndef INTERFACE_ATLAS_H
#define INTERFACE_ATLAS_H

#include "types.h"

// Push constants of surface_atlas: how texture coordinates are laid out.
struct atlas_layout {
    float4 u; // xyz: row of the map's transform
    float4 v;
    uint second_coordinates; // 1: the second set
    uint padding_0;
    uint padding_1;
    uint padding_2;
};
INTERFACE_SIZE(atlas_layout, 48)
INTERFACE_OFFSET(atlas_layout, v, 16)
INTERFACE_OFFSET(atlas_layout, second_coordinates, 32)

#endif
