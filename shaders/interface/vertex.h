#ifndef INTERFACE_VERTEX_H
#define INTERFACE_VERTEX_H

#include "types.h"

// Read as std430 by gl_VertexIndex; the same bytes as lobe_scene_vertex.
struct vertex {
    float position[3];
    float normal[3];
    float tangent[4];
    float texture_coordinates[4]; // two sets
    float colour[4];
};
INTERFACE_SIZE(vertex, 72)
INTERFACE_OFFSET(vertex, normal, 12)
INTERFACE_OFFSET(vertex, tangent, 24)
INTERFACE_OFFSET(vertex, texture_coordinates, 40)
INTERFACE_OFFSET(vertex, colour, 56)

#endif
