#version 460
#extension GL_GOOGLE_include_directive : require

// Which directions each path's start sees: the facet itself, and those of the coarse relief's cell
// under it. Four directions a word, WU_SIGHT_BITS each. A thread for each path and word.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 4, std430) readonly buffer first_block { vec4 first[]; };
layout(set = 0, binding = 5, std430) writeonly buffer sight_block { uint sights[]; };

void main() {
    uint words = filled_direction_count() / 4u;
    uint index = gl_GlobalInvocationID.x / words, place = gl_GlobalInvocationID.x % words;
    if (index >= path_count())
        return;
    uint cell = cell_at(wu.levels[stage.level], path_start(index)), word = 0u;
    float depth = depth_in_facet(index);
    vec4 light = first[gl_GlobalInvocationID.x];
    for (uint i = 0u; i < 4u; ++i) {
        vec2 parts = facets_seen(cell, direction_at(4u * place + i)).parts;
        uint seen = (parts.x > depth ? WU_SEES_LOWER : 0u) +
                    (parts.y > depth ? WU_SEES_UPPER : 0u) +
                    (light[i] > 0.0 ? WU_SEES_FACET : 0u);
        word |= seen << (WU_SIGHT_BITS * i);
    }
    sights[gl_GlobalInvocationID.x] = word;
}
