#ifndef ENVIRONMENT_CHECK_H
#define ENVIRONMENT_CHECK_H

#include "../../../shaders/interface/types.h"

// The look-up method: the specialisation constant CHECK_METHOD of check.comp.
#define CHECK_METHOD       0
#define METHOD_PREFILTERED 0
#define METHOD_MIP         1
#define METHOD_SAMPLED     2
#define METHOD_BLENDED     3

// Workgroup size of check_exact.comp, and the number of lobes that it sums up together.
#define CHECK_GROUP_SIZE 64
#define CHECK_LOBES      7

// Push constants of check.comp.
struct environment_check_constants {
    float concentration; // of the lobe about each direction
    uint count;          // directions
    uint samples;        // METHOD_SAMPLED
    uint padding;
};
INTERFACE_SIZE(environment_check_constants, 16)

// Push constants of check_exact.comp.
struct environment_check_exact_constants {
    float concentrations[CHECK_LOBES];
    uint count;       // directions
    uint first_texel; // of the cube's level 0: row after row, face after face
    uint texel_count; // to add, a multiple of CHECK_GROUP_SIZE
};
INTERFACE_SIZE(environment_check_exact_constants, 40)

#endif
