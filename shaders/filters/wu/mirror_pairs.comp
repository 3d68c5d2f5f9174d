#version 460
#extension GL_GOOGLE_include_directive : require

// Of each patch and pair of directions, the area of microfacets that mirror one into the other: of
// facets that see both, and of facets where the coarse relief sees both. The facets are the same,
// so that their quotient has little noise. A thread for each patch and sixteen pairs: fewer reads.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 4, std430) readonly buffer vertex_block { path_point points[]; };
layout(set = 0, binding = 6, std430) readonly buffer sight_block { uint sights[]; };
// Seen by facets, and by the coarse relief.
layout(set = 0, binding = 7, std430) writeonly buffer mirror_pair_block { vec2 pairs[]; };

// What one facet adds to a pair. `both`: who sees both directions.
vec2 mirrored_area(vec3 normal, vec3 incoming, vec3 outgoing, uint both) {
    if (dot(normal, incoming) <= 0.0 || dot(normal, outgoing) <= 0.0)
        return vec2(0.0);
    vec3 halfway = normalize(incoming + outgoing);
    float area = exp(WU_MIRROR_CONCENTRATION * (dot(normal, halfway) - 1.0)) / normal.z;
    uint coarse = both & (WU_SEES_LOWER | WU_SEES_UPPER);
    return area * vec2((both & WU_SEES_FACET) != 0u ? 1.0 : 0.0, 0.5 * float(bitCount(coarse)));
}

void store(uint patch_index, uint i, uint j, vec2 value) {
    uint directions = direction_count(), first = patch_index * directions * directions;
    if (i >= directions || j >= directions)
        return;
    pairs[first + i * directions + j] = value;
    pairs[first + j * directions + i] = value;
}

void main() {
    uint row = filled_direction_count() / 4u;
    uint patch_index = gl_GlobalInvocationID.x / (row * row);
    uint block = gl_GlobalInvocationID.x % (row * row), i = block / row, j = block % row;
    if (patch_index >= wu.patches * wu.patches || j > i)
        return;
    vec3 incoming[4], outgoing[4];
    for (uint n = 0u; n < 4u; ++n) {
        incoming[n] = direction_at(4u * i + n);
        outgoing[n] = direction_at(4u * j + n);
    }
    vec2 sums[16];
    for (uint pair = 0u; pair < 16u; ++pair)
        sums[pair] = vec2(0.0);
    for (uint k = patch_index * wu.points; k < (patch_index + 1u) * wu.points; ++k) {
        vec3 normal = points[k * wu.bounces].normal.xyz;
        uint seen_i = sights[k * row + i], seen_j = sights[k * row + j];
        for (uint pair = 0u; pair < 16u; ++pair) {
            uint line = pair / 4u, column = pair % 4u;
            uint both = seen_i >> (WU_SIGHT_BITS * line) & seen_j >> (WU_SIGHT_BITS * column);
            sums[pair] += mirrored_area(normal, incoming[line], outgoing[column], both);
        }
    }
    // Of a block on the diagonal, each pair once.
    for (uint pair = 0u; pair < 16u; ++pair)
        if (i != j || pair / 4u >= pair % 4u)
            store(patch_index, 4u * i + pair / 4u, 4u * j + pair % 4u,
                  sums[pair] / float(wu.points));
}
