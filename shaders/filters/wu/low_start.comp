#version 460
#extension GL_GOOGLE_include_directive : require

// Of a coarse relief: the mean slopes of the facets under each cell, which low_heights looks for
// heights to; and the mean heights around each vertex, where it starts. A thread for each cell and
// the vertex at its first corner.

#include "filters/displaced/height_field.glsl"
#include "filters/wu/cells.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 4, std430) writeonly buffer low_block { float low_heights[]; };
layout(set = 0, binding = 5, std430) writeonly buffer slope_block { vec2 slopes[]; };

float height_at(ivec2 texel) {
    return vertex_height(first_period(texel));
}

// Wu et al., 2019, Eq. 1: the slopes of quads telescope, so that only a cell's sides matter.
vec2 mean_slope(ivec2 first, ivec2 last) {
    vec2 sum = vec2(0.0);
    for (int y = first.y; y <= last.y; ++y) {
        float weight = y == first.y || y == last.y ? 0.5 : 1.0;
        sum.x += weight * (height_at(ivec2(last.x, y)) - height_at(ivec2(first.x, y)));
    }
    for (int x = first.x; x <= last.x; ++x) {
        float weight = x == first.x || x == last.x ? 0.5 : 1.0;
        sum.y += weight * (height_at(ivec2(x, last.y)) - height_at(ivec2(x, first.y)));
    }
    return sum / float((last.x - first.x) * (last.y - first.y));
}

float mean_of_heights(ivec2 vertex, ivec2 reach) {
    float sum = 0.0;
    for (int y = -reach.y; y <= reach.y; ++y)
        for (int x = -reach.x; x <= reach.x; ++x)
            sum += height_at(vertex + ivec2(x, y));
    return sum / float((2 * reach.x + 1) * (2 * reach.y + 1));
}

void main() {
    wu_level level = wu.levels[stage.level];
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy), size = ivec2(level.width, level.height);
    if (cell.x >= size.x || cell.y >= size.y)
        return;
    ivec2 first = cell * relief_size() / size, last = (cell + 1) * relief_size() / size;
    int index = cell.y * size.x + cell.x;
    slopes[index] = mean_slope(first, last);
    ivec2 reach = min((last - first) / 2, (relief_size() - 1) / 2);
    low_heights[index] = (mean_of_heights(first, reach) - mean_height()) / level.unit;
}
