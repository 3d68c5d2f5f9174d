#version 460
#extension GL_GOOGLE_include_directive : require

// Mean and largest height of a relief, and mean distance of its normals, from those of its rows.
// One thread.

#include "interface/displacement/relief.h"

layout(local_size_x = 1) in;

layout(set = 0, binding = 1, std140) uniform height_field_block { height_field_constants relief; };
layout(set = 0, binding = 3, std430) readonly buffer row_block { vec4 rows[]; };
layout(set = 0, binding = 4, std430) writeonly buffer height_extent_block { vec4 height_extent; };

void main() {
    float sum = 0.0, largest = -HEIGHT_MAXIMUM, distances = 0.0;
    for (uint i = 0u; i < relief.height; ++i) {
        sum += rows[i].x;
        largest = max(largest, rows[i].y);
        distances += rows[i].z;
    }
    float scale = 1.0 / float(relief.height);
    height_extent = vec4(scale * sum, largest, scale * distances, 0.0);
}
