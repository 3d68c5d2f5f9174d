#ifndef INTERFACE_CLUSTERING_H
#define INTERFACE_CLUSTERING_H

#include "types.h"

// Push constants of lobe_clustering, parameter_averaging and moment_binning. They bound the loops
// over texels: with a uniform block instead, lavapipe would recompile the shader for each content.
struct clustering_constants {
    uint width; // of the base maps, texels: the larger of the normal and the width map
    uint height;
};
INTERFACE_SIZE(clustering_constants, 8)
INTERFACE_OFFSET(clustering_constants, height, 4)

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
