#version 460
#extension GL_GOOGLE_include_directive : require

// Of each patch and pair of directions, the area of microfacets that mirror one into the other: of
// facets that see both, and of facets where the coarse relief sees both. The facets are the same,
// so that their quotient has little noise. A thread for each patch and pair.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 4, std430) readonly buffer vertex_block { path_point points[]; };
layout(set = 0, binding = 5, std430) readonly buffer first_block { float first[]; };
layout(set = 0, binding = 6, std430) readonly buffer sight_block { uint sights[]; };
// Seen by facets, and by the coarse relief.
layout(set = 0, binding = 7, std430) writeonly buffer mirror_pair_block { vec2 pairs[]; };

void main() {
    uint directions = direction_count(), row = filled_direction_count();
    uint patch_index = gl_GlobalInvocationID.x / (directions * directions);
    uint pair = gl_GlobalInvocationID.x % (directions * directions);
    uint i = pair / directions, j = pair % directions;
    if (patch_index >= wu.patches * wu.patches || j > i)
        return;
    vec3 incoming = direction_of_index(i, wu.angular), outgoing = direction_of_index(j, wu.angular);
    vec3 halfway = normalize(incoming + outgoing);
    vec2 sum = vec2(0.0);
    for (uint k = patch_index * wu.points; k < (patch_index + 1u) * wu.points; ++k) {
        vec3 normal = points[k * wu.bounces].normal.xyz;
        if (dot(normal, incoming) <= 0.0 || dot(normal, outgoing) <= 0.0)
            continue;
        float area = exp(WU_MIRROR_CONCENTRATION * (dot(normal, halfway) - 1.0)) / normal.z;
        bool seen = first[k * row + i] > 0.0 && first[k * row + j] > 0.0;
        uint both = sights[k * row + i] & sights[k * row + j];
        sum += area * vec2(seen ? 1.0 : 0.0, 0.5 * float(bitCount(both)));
    }
    sum /= float(wu.points);
    pairs[patch_index * directions * directions + i * directions + j] = sum;
    pairs[patch_index * directions * directions + j * directions + i] = sum;
}
