#ifndef MIRRORED_LIGHT_GLSL
#define MIRRORED_LIGHT_GLSL

// What microfacets of a relief's facets mirror, from sums over bins of their normals. Whoever
// includes this declares BIN_COLOUR and BIN_WIDTHS before.

#include "filters/moments/plane_bin.glsl"
#include "shading/base_material.glsl"

light_sum no_light() {
    return light_sum(0.0, vec2(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0);
}

// Of a bin, of which others hide all but a part. Its microfacets hide each other as its own facets
// are seen: on flanks that face away from each other a mean over all facets would not tell.
void add_seen_bin(inout light_sum sum, plane_bin bin, vec3 halfway, vec3 outgoing, vec3 incoming,
                  float part) {
    light_sum own = no_light();
    add_masked_bin(own, bin, halfway, plane_from_direction(halfway), outgoing, incoming);
    sum.reflected += part * own.reflected;
    sum.outgoing += part * own.outgoing;
}

// Cook, Torrance, 1982, of all facets, over the base's area.
vec3 mirrored_light(base_material base, light_sum sum, vec3 fresnel) {
    float cosine = sum.outgoing / max(sum.reflected, 1e-20);
    return fresnel * scattering_scale(base.specular, cosine, base.width) * sum.outgoing;
}

#endif
