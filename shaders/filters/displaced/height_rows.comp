#version 460
#extension GL_GOOGLE_include_directive : require

// Mean and largest height of each row of a relief.

#include "interface/displacement/relief.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 1, std140) uniform height_field_block { height_field_constants relief; };
layout(set = 0, binding = 2, std430) readonly buffer height_block { float heights[]; };
layout(set = 0, binding = 3, std430) writeonly buffer row_block { vec2 rows[]; };

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= relief.height)
        return;
    float sum = 0.0, largest = -HEIGHT_MAXIMUM;
    for (uint i = 0u; i < relief.width; ++i) {
        float height = heights[row * relief.width + i];
        sum += height;
        largest = max(largest, height);
    }
    rows[row] = vec2(sum / float(relief.width), largest);
}
