#version 460
#extension GL_GOOGLE_include_directive : require

// What normals drawn from the lobes of the cells at points of each patch get from each direction of
// the table, where the coarse relief sees it: products of two have the light of f'_low as mean. By
// the printed Eq. 5, the second factor is the area that the viewer sees. A thread for each sample
// and direction.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 5, std430) writeonly buffer first_block { float first[]; };
layout(set = 0, binding = 6, std430) writeonly buffer second_block { float second[]; };

float weight_of_lobes(uint cell) {
    float sum = 0.0;
    for (uint i = 0u; i < WU_LOBES; ++i)
        sum += length(cells[cell].lobes[i].xyz);
    return sum;
}

vec3 drawn_normal(uint cell, float total, uint seed) {
    float rest = total * hashed_number(seed);
    uint which = 0u;
    for (; which + 1u < WU_LOBES; ++which) {
        float weight = length(cells[cell].lobes[which].xyz);
        if (rest < weight)
            break;
        rest -= weight;
    }
    vec4 lobe = cells[cell].lobes[which];
    float cosine = lobe_cosine(lobe.w, 1.0 - hashed_number(seed + 1u));
    float angle = 2.0 * PI * hashed_number(seed + 2u);
    vec3 local = vec3(sqrt(max(1.0 - cosine * cosine, 0.0)) * vec2(cos(angle), sin(angle)), cosine);
    float size = length(lobe.xyz);
    return frame_of_axis(size > 0.0 ? lobe.xyz / size : vec3(0.0, 0.0, 1.0)) * local;
}

void main() {
    uint directions = filled_direction_count();
    uint index = gl_GlobalInvocationID.y, which = gl_GlobalInvocationID.x;
    if (index >= path_count() * WU_DRAWS || which >= directions)
        return;
    uint place = index * directions + which;
    uint cell = cell_at(wu.levels[stage.level], path_start(index / WU_DRAWS));
    // Directions that fill up the table get nothing.
    vec3 direction =
        which < direction_count() ? direction_of_index(which, wu.angular) : vec3(0.0);
    float total = weight_of_lobes(cell);
    vec3 normal = drawn_normal(cell, total, hash(index));
    seen_facets seen = facets_seen(cell, direction);
    uint facet = index & 1u;
    float light = max(dot(normal, direction), 0.0);
    if (!is_printed(WU_PRINTED_LOBES)) {
        first[place] = seen.parts[facet] > depth_in_facet(index) ? sqrt(total) * light : 0.0;
        return;
    }
    vec2 slope = facet == 0u ? cells[cell].slopes.xy : cells[cell].slopes.zw;
    float area = seen.areas[facet];
    first[place] =
        total * light * area * inversesqrt(1.0 + dot(slope, slope)) / max(direction.z, 1e-3);
    second[place] = area;
}
