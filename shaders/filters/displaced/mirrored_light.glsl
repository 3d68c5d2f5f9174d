#ifndef MIRRORED_LIGHT_GLSL
#define MIRRORED_LIGHT_GLSL

// What microfacets of a relief's facets mirror, from sums over bins of their normals. Whoever
// includes this declares BIN_COLOUR and BIN_WIDTHS before.

#include "filters/moments/plane_bin.glsl"
#include "shading/base_material.glsl"

light_sum no_light() {
    return light_sum(0.0, vec2(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0);
}

void add_light(inout light_sum sum, light_sum other, float factor) {
    sum.distribution += factor * other.distribution;
    sum.place += factor * other.place;
    sum.second_moments += factor * other.second_moments;
}

// Cook, Torrance, 1982, of all facets, over the base's area, where facets do not hide each other.
vec3 mirrored_light(base_material base, light_sum sum, vec3 fresnel, vec3 outgoing,
                    vec3 incoming) {
    float scale = 1.0 / max(sum.distribution, 1e-20);
    facing_cosines cosines = facing_cosines_of(
        normal_spread_of(scale * sum.place, scale * sum.second_moments), incoming, outgoing);
    float visible = masking_shadowing(DISTRIBUTION, cosines.incoming, cosines.outgoing, base.width);
    return fresnel * scattering_scale(base.specular, cosines.outgoing, base.width) *
           (0.25 * cosines.share * sum.distribution * visible);
}

#endif
