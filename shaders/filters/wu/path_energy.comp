#version 460
#extension GL_GOOGLE_include_directive : require

// Of light from everywhere on a white relief: the part that is reflected at once, and the part of
// the rest that meets more than two facets. One group.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 4, std430) readonly buffer vertex_block { path_point points[]; };
layout(set = 0, binding = 5, std430) readonly buffer first_block { float first[]; };
layout(set = 0, binding = 6, std430) readonly buffer second_block { float second[]; };
// x: the part that is reflected at once; y: persistence [0, 1)
layout(set = 0, binding = 8, std430) writeonly buffer whole_block { vec4 energy; };

shared vec3 sums[64];

void main() {
    uint directions = direction_count(), row = filled_direction_count();
    uint own = gl_LocalInvocationIndex;
    float whole = 0.0;
    for (uint j = 0u; j < directions; ++j)
        whole += direction_of_index(j, wu.angular).z;
    vec3 sum = vec3(0.0); // light of one facet, of two, area that is seen
    for (uint i = own; i < path_count(); i += 64u) {
        float root = inversesqrt(points[i * wu.bounces].normal.z), at_first = 0.0, at_second = 0.0;
        for (uint j = 0u; j < directions; ++j) {
            at_first += first[i * row + j];
            at_second += second[i * row + j];
        }
        at_first /= whole;
        sum += vec3(at_first * at_first, at_first * root * at_second / whole, at_first * root);
    }
    sums[own] = sum;
    barrier();
    if (own != 0u)
        return;
    sum = vec3(0.0);
    for (uint i = 0u; i < 64u; ++i)
        sum += sums[i];
    sum.xy /= max(sum.z, 1e-20);
    float rest = 1.0 - sum.x;
    float persistence = rest > 1e-4 ? clamp(1.0 - sum.y / rest, 0.0, 0.999) : 0.0;
    energy = vec4(sum.x, wu.bounces > 1u ? persistence : 0.0, 0.0, 0.0);
}
