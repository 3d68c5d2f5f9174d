#ifndef CORNER_ANGLE_GLSL
#define CORNER_ANGLE_GLSL

// What the passes that pose points and measure charts read of a mesh, and the angles of its
// triangles, by which both weight them.

#include "interface/displacement/displacement.h"
#include "interface/vertex.h"

layout(set = 0, binding = 0, std430) readonly buffer base_point_block {
    base_point base_points[];
};
layout(set = 0, binding = 1, std430) readonly buffer chart_block { base_chart charts[]; };
layout(set = 0, binding = 2, std430) readonly buffer corner_block { uint corners[]; };
layout(set = 0, binding = 3, std430) readonly buffer index_block { uint indices[]; };
layout(set = 0, binding = 4, std430) readonly buffer vertex_block { vertex vertices[]; };

layout(push_constant) uniform constants_block { pose_constants constants; };

vec3 vertex_position(uint index) {
    return vec3(vertices[index].position[0], vertices[index].position[1],
                vertices[index].position[2]);
}

// The vertices of a corner's triangle, that of the corner first.
uvec3 vertices_from(uint corner) {
    uint first = corner - corner % 3u;
    return uvec3(indices[corner], indices[first + (corner + 1u) % 3u],
                 indices[first + (corner + 2u) % 3u]);
}

float largest_element(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// Radians; 0 where the triangle has no area there. Squares may be out of range at any scale.
float angle_between(vec3 a, vec3 b) {
    a /= max(largest_element(a), 1e-37);
    b /= max(largest_element(b), 1e-37);
    return atan(length(cross(a, b)), dot(a, b));
}

// Of the thread; past the end if there is none.
uint thread_number() {
    return gl_GlobalInvocationID.x < constants.row
               ? gl_GlobalInvocationID.y * constants.row + gl_GlobalInvocationID.x
               : constants.count;
}

#endif
