#version 460
#extension GL_GOOGLE_include_directive : require

// Which facets each facet sees, in TRANSFER_LINKS directions drawn with its cosine; ~0: the sky.
// The directions are stratified, and the same in every run.

#include "filters/displaced/facets.glsl"
#include "lib/number/constants.glsl"
#include "lib/number/hash.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 4, std430) writeonly buffer link_block { uint links[]; };

mat3 frame_about(vec3 normal) {
    vec3 along = normalize(cross(abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0),
                                 normal));
    return mat3(along, cross(normal, along), normal);
}

void main() {
    uint index = transfer.first_thread + gl_GlobalInvocationID.x;
    if (index >= facet_count())
        return;
    facet own = facet_of(index);
    mat3 frame = frame_about(own.normal);
    // Of the facet in the relief, so that windows do not matter.
    uint seed = hash(2u * (uint(own.quad.y) * relief.width + uint(own.quad.x)) +
                     (own.upper ? 1u : 0u));
    float turn = hashed_number(seed);
    uint first = (index - transfer.first_facet) * TRANSFER_LINKS;
    for (uint i = 0u; i < TRANSFER_LINKS; ++i) {
        float square = (float(i) + hashed_number(seed + 1u + i)) / float(TRANSFER_LINKS);
        // Quarters of a turn, in another order than the radii.
        float angle = 2.0 * PI * (turn + 0.25 * float((i * 2u + i / 2u) % 4u));
        vec3 local = vec3(sqrt(square) * vec2(cos(angle), sin(angle)), sqrt(1.0 - square));
        relief_hit hit = trace_relief(own.centre, frame * local);
        links[first + i] = hit.found ? facet_index(hit.quad, hit.upper) : ~0u;
    }
}
