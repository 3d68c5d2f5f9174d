#ifndef INTERFACE_CLUSTERING_ATLAS_H
#define INTERFACE_CLUSTERING_ATLAS_H

#include "types.h"

// Push constants of filters/lobes/clustering_atlas.comp.
struct atlas_constants {
    float4 rotation[3]; // rows: from the space of the atlas to that of the mixtures
    float4 eye;         // in the space of the atlas; w: 1 perspective (a position), 0 orthographic
                        // (a direction), -1: surfaces that face away are kept
    uint width;
    uint height;
    uint padding_0;
    uint padding_1;
};
INTERFACE_SIZE(atlas_constants, 80)
INTERFACE_OFFSET(atlas_constants, eye, 48)
INTERFACE_OFFSET(atlas_constants, width, 64)
INTERFACE_OFFSET(atlas_constants, height, 68)

#endif
