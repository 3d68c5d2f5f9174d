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
    float alpha; // as in lobe_grid_constants
    float cutoff;
};
INTERFACE_SIZE(atlas_constants, 80)
INTERFACE_OFFSET(atlas_constants, eye, 48)
INTERFACE_OFFSET(atlas_constants, width, 64)
INTERFACE_OFFSET(atlas_constants, height, 68)
INTERFACE_OFFSET(atlas_constants, alpha, 72)
INTERFACE_OFFSET(atlas_constants, cutoff, 76)

#endif
