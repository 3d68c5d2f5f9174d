#version 460
#extension GL_GOOGLE_include_directive : require

// The colours of each facet (interface/displacement/relief.h): of what it reflects diffusely below
// what it mirrors at right angles, since metal mirrors most where nothing is diffuse, and of all
// that it reflects, which counts between facets. The maps lie on the relief as its heights
// do. One thread a facet.

#include "interface/displacement/relief.h"
#include "interface/mirrored.h"
#include "lib/displacement/facet_points.glsl"
#include "lib/map/base_texel.glsl"

layout(local_size_x = 64) in;

layout(constant_id = SPECIALISE_MODEL) const uint MODEL = MODEL_MICROFACET;
layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = false;

layout(set = 0, binding = 1) uniform sampler2D base_colour_map;
layout(set = 0, binding = 2) uniform sampler2D width_map;
layout(set = 0, binding = 3, std430) writeonly buffer colour_words { uint words[]; };

layout(push_constant) uniform colour_block { colour_constants constants; };

struct facet_colours {
    vec3 diffuse;
    vec3 reflected;
};

facet_colours colours_at(vec2 point) {
    vec3 albedo =
        clamp(constants.base_colour.rgb * base_texel(base_colour_map, point).rgb, 0.0, 1.0);
    if (MODEL != MODEL_MICROFACET)
        return facet_colours(albedo, albedo);
    float metallic = constants.metallic;
    if (METALLIC_MAP)
        metallic *= base_texel(width_map, point).b;
    // glTF 2.0, appendix B.2.
    vec3 mirrored = mix(vec3(DIELECTRIC_F0), albedo, metallic);
    vec3 diffuse = albedo * (1.0 - metallic) * (1.0 - mirrored);
    return facet_colours(diffuse, mirrored + diffuse);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= 2u * constants.width * constants.height)
        return;
    uint quad = index / 2u;
    vec2 vertex = vec2(constants.origin_x + quad % constants.width,
                       constants.origin_y + quad / constants.width) + 0.5;
    facet_colours mean = facet_colours(vec3(0.0), vec3(0.0));
    uint count = constants.points * constants.points;
    for (uint i = 0u; i < count; ++i) {
        vec2 inside = point_in_facet(i, constants.points, (index & 1u) != 0u);
        facet_colours colours =
            colours_at((vertex + inside) / vec2(constants.relief_width, constants.relief_height));
        mean.diffuse += colours.diffuse / float(count);
        mean.reflected += colours.reflected / float(count);
    }
    words[index * TRANSFER_COLOUR_WORDS] = packHalf2x16(mean.diffuse.rg);
    words[index * TRANSFER_COLOUR_WORDS + 1u] =
        packHalf2x16(vec2(mean.diffuse.b, mean.reflected.r));
    words[index * TRANSFER_COLOUR_WORDS + 2u] = packHalf2x16(mean.reflected.gb);
}
