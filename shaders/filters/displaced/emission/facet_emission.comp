#version 460
#extension GL_GOOGLE_include_directive : require

// The light that each facet sends out because facets shine: in the first step e, what it emits
// itself; in later ones m = e + r mean m over its links, with what it reflects, r. The map lies on
// the relief as its heights do. One thread a facet.

#include "filters/displaced/facets.glsl"
#include "filters/displaced/facet_colours.glsl"
#include "lib/displacement/facet_points.glsl"
#include "lib/map/base_texel.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 1) uniform sampler2D emissive_map;
layout(set = 0, binding = 5, std430) readonly buffer link_block { uint links[]; };
layout(set = 0, binding = 6, std430) readonly buffer source_block { vec4 source[]; };
layout(set = 0, binding = 7, std430) readonly buffer emitted_block { vec4 emitted[]; };
layout(set = 0, binding = 8, std430) writeonly buffer target_block { vec4 target[]; };

vec3 emission_of_map(uint index) {
    facet here = facet_of(index);
    uint points = facet_points(textureSize(emissive_map, 0), relief_size());
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < points * points; ++i) {
        vec2 inside = point_in_facet(i, points, here.upper);
        vec2 place = (vec2(here.quad) + 0.5 + inside) / vec2(relief_size());
        sum += base_texel(emissive_map, place).rgb;
    }
    return sum / float(points * points);
}

vec3 reflected(uint index) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < TRANSFER_LINKS; ++i) {
        uint link = links[index * TRANSFER_LINKS + i];
        if (link != ~0u)
            sum += source[link].rgb;
    }
    vec3 colour = vec3(colours_of_facet(index, 0u).y, colours_of_facet(index, 1u).y,
                       colours_of_facet(index, 2u).y);
    return colour * sum / float(TRANSFER_LINKS);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= facet_count())
        return;
    target[index] = vec4(transfer.first != 0u ? emission_of_map(index)
                                              : emitted[index].rgb + reflected(index), 0.0);
}
