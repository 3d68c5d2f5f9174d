#ifndef COORDINATES_GLSL
#define COORDINATES_GLSL

// Where the height map lies on the base mesh.

#include "displacement/base_mesh.glsl"
#include "interface/vertex.h"

layout(set = 0, binding = 5, std430) readonly buffer pair_block { uint pairs[]; };
layout(set = 0, binding = 7, std430) readonly buffer vertex_block { vertex vertices[]; };

vec2 map_coordinates(vec2 set) {
    return vec2(dot(constants.map_rows[0].xyz, vec3(set, 1.0)),
                dot(constants.map_rows[1].xyz, vec3(set, 1.0)));
}

vec2 vertex_coordinates(uint index) {
    uint first = 2u * constants.second_set;
    return map_coordinates(vec2(vertices[index].texture_coordinates[first],
                                vertices[index].texture_coordinates[first + 1u]));
}

vec2 chart_coordinates(uint chart) {
    return vertex_coordinates(charts[chart].vertex);
}

#endif
