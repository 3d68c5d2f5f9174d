#ifndef INTERFACE_COLOUR_CORRELATION_H
#define INTERFACE_COLOUR_CORRELATION_H

#include "../types.h"

// Push constants of colour_correlation. No specialisation constants: one pipeline serves all
// materials.
struct colour_correlation_constants {
    uint width; // of the grid of lobes, texels
    uint height;
    uint normals;       // NORMALS_...: how the normal map has them
    float normal_scale; // of the material
    float metallic;     // factor of the width map's blue
    float alpha;        // factor of the base colour map's alpha
    float cutoff;       // what is below is cut away; 0: nothing is
};
INTERFACE_SIZE(colour_correlation_constants, 28)
INTERFACE_OFFSET(colour_correlation_constants, height, 4)
INTERFACE_OFFSET(colour_correlation_constants, normals, 8)
INTERFACE_OFFSET(colour_correlation_constants, normal_scale, 12)
INTERFACE_OFFSET(colour_correlation_constants, metallic, 16)
INTERFACE_OFFSET(colour_correlation_constants, alpha, 20)
INTERFACE_OFFSET(colour_correlation_constants, cutoff, 24)

#define COLOUR_CORRELATION_LEVELS 16 // of the largest map

// What colour_correlation finds (std140).
struct colour_correlation_found {
    uint follow; // 1: colours go with normals, 0: nowhere
    uint padding_0;
    uint padding_1;
    uint padding_2;
    // Groups of the dispatches that make each level of the map of colours and normals, as
    // lobe_dispatch_arguments, four to a level; none where colours do not follow.
    uint4 groups[COLOUR_CORRELATION_LEVELS];
};
INTERFACE_SIZE(colour_correlation_found, 272)
INTERFACE_OFFSET(colour_correlation_found, groups, 16)

#endif
