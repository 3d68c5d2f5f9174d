#ifndef VIEWER_OUTPUTS_H
#define VIEWER_OUTPUTS_H

#include "../../../shaders/interface/types.h"

// Push constants of outputs.frag.
struct outputs_constants {
    uint depth;  // 1: depth, 0: normals
    float scale; // metres at which depth is middle grey
    uint padding_0;
    uint padding_1;
};
INTERFACE_SIZE(outputs_constants, 16)

#endif
