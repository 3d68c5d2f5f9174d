#ifndef INTERFACE_DEFORMATION_H
#define INTERFACE_DEFORMATION_H

#include "types.h"

// Read as std430; the same bytes as lobe_joint_influence and lobe_morph_delta.
struct joint_influence {
    uint joint;
    float weight;
};
INTERFACE_SIZE(joint_influence, 8)
INTERFACE_OFFSET(joint_influence, weight, 4)

struct morph_delta {
    uint target;
    float position[3];
    float normal[3];
    float tangent[3];
};
INTERFACE_SIZE(morph_delta, 40)
INTERFACE_OFFSET(morph_delta, position, 4)
INTERFACE_OFFSET(morph_delta, normal, 16)
INTERFACE_OFFSET(morph_delta, tangent, 28)

// Push constants of the pass that deforms a mesh.
struct deform_constants {
    uint vertex_count;
    uint influences; // per vertex; 0: no joints
    uint targets;    // 1: there are morph targets
    uint faceted;    // 1: each three vertices are a triangle, whose normal they have
    uint row;        // threads in a row of the dispatch
};
INTERFACE_SIZE(deform_constants, 20)
INTERFACE_OFFSET(deform_constants, influences, 4)
INTERFACE_OFFSET(deform_constants, targets, 8)
INTERFACE_OFFSET(deform_constants, faceted, 12)
INTERFACE_OFFSET(deform_constants, row, 16)

#endif
