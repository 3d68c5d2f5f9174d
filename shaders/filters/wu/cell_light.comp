#version 460
#extension GL_GOOGLE_include_directive : require

// What the lobes of the cell at each path's start get from each direction of the table, where the
// coarse relief sees it: light between facets is scaled by products of two, since the facets that
// light meets first are others than those that the viewer sees. A thread for each path and
// direction.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 4, std430) writeonly buffer light_block { float light[]; };

float light_of_lobes(uint cell, vec3 direction) {
    float sum = 0.0;
    for (uint i = 0u; i < WU_LOBES; ++i) {
        vec4 lobe = cells[cell].lobes[i];
        float weight = length(lobe.xyz);
        lobe_normals normals = normals_of_weighted(lobe, weight);
        for (int k = 0; k < 8; ++k)
            sum += weight / 8.0 * max(dot(normals.normals[k], direction), 0.0);
    }
    return sum;
}

void main() {
    uint directions = filled_direction_count();
    uint index = gl_GlobalInvocationID.x / directions, which = gl_GlobalInvocationID.x % directions;
    if (index >= path_count())
        return;
    // Directions that fill up the table get nothing.
    vec3 direction =
        which < direction_count() ? direction_of_index(which, wu.angular) : vec3(0.0);
    uint cell = cell_at(wu.levels[stage.level], path_start(index));
    light[gl_GlobalInvocationID.x] =
        part_seen(facets_seen(cell, direction)) * light_of_lobes(cell, direction);
}
