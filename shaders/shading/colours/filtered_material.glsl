#ifndef FILTERED_MATERIAL_GLSL
#define FILTERED_MATERIAL_GLSL

// The material of a footprint: what its maps are on average.

#include "shading/colours/width_means.glsl"

layout(constant_id = SPECIALISE_METAL_MEANS) const uint METAL_MEANS = METAL_MEANS_NONE;

layout(LOBE_DESCRIPTOR(46)) uniform sampler2DArray metal_map;

// Means over a footprint of colours c and of metal's share m, factors of the material included.
struct metal_means {
    vec3 colour; // E[c]
    vec3 metal;  // E[c m]
    float share; // E[m]
    float square; // E[m^2]
};

// The map as which the means lie.
int metal_map_layout() {
    return WIDTHS_APART ? MAP_WIDTH : lobe_map();
}

// Whether a mask counts in them.
const bool METAL_MASKED = MASKED_LOBES && !WIDTHS_APART;

bool metal_has_colours() {
    return METAL_MEANS >= METAL_MEANS_COLOURED;
}

// The layers of the map, from samples of the base maps.
void layers_of_level_0(surface_point surface, vec2 position, out vec4 metal, out vec4 colour) {
    float share = base_texel(width_map, position).b;
    vec4 texel = metal_has_colours() || METAL_MASKED ? base_texel(base_colour_map, position)
                                                     : vec4(1.0);
    float kept = !METAL_MASKED || is_kept(texel.a, surface) ? 1.0 : 0.0;
    metal = kept * (metal_has_colours() ? share * vec4(texel.rgb, share)
                                        : vec4(share, 1.0, 0.0, share * share));
    colour = METAL_MASKED ? kept * vec4(share, 1.0, 0.0, 0.0) : vec4(texel.rgb, share);
}

vec2 metal_map_size() {
    vec2 size = WIDTHS_APART ? vec2(textureSize(width_map, 0)) : lobe_map_size();
    return METAL_MEANS == METAL_MEANS_FINER ? max(size, vec2(textureSize(base_colour_map, 0)))
                                            : size;
}

metal_means fetch_metal_means(surface_point surface, map_area lobes) {
    map_area area = lobes;
    if (METAL_MEANS == METAL_MEANS_FINER || WIDTHS_APART)
        area = area_of(metal_map_layout(), metal_map_size(), surface);
    vec4 metal = vec4(0.0), colour = vec4(0.0);
    for (uint i = 0u; i < probes_of(area); ++i) {
        vec4 own = fetch_probe(metal_map, METAL_LAYER_METAL, area, i);
        vec4 own_colour = metal_has_colours()
                              ? fetch_probe(metal_map, METAL_LAYER_COLOUR, area, i)
                              : vec4(0.0);
        if (may_see_level_0(metal_map_layout())) {
            vec4 finest, finest_colour;
            layers_of_level_0(surface, probe_position(area, i), finest, finest_colour);
            own = mix(finest, own, area.share);
            own_colour = mix(finest_colour, own_colour, area.share);
        }
        metal += own;
        colour += own_colour;
    }
    metal /= float(probes_of(area));
    colour /= float(probes_of(area));
    if (!metal_has_colours()) {
        metal *= per_kept(metal.g);
        metal = metal.rrra;
        colour = metal.rrrr;
    } else if (METAL_MASKED) {
        float scale = per_kept(colour.g);
        metal *= scale;
        colour.a = scale * colour.r;
    }
    if (METAL_MEANS == METAL_MEANS_ALONE || METAL_MASKED)
        colour.rgb = filtered_base_colour(surface, lobes).rgb;
    if (METAL_MEANS == METAL_MEANS_ALONE)
        metal.rgb *= colour.rgb;
    vec3 factor = material.base_colour.rgb * (VERTEX_COLOUR ? surface.colour.rgb : vec3(1.0));
    float metallic = material.metallic;
    return metal_means(factor * colour.rgb, metallic * factor * metal.rgb, metallic * colour.a,
                       metallic * metallic * metal.a);
}

// The mean of diffuse colours c (1 - m) under F0. Shading multiplies it by one minus the mean F0;
// but what reflects most of the light is metal, which has no diffuse colour: the colour is divided
// by what the mean F0 lets through, and times what F0 does where the colour is.
vec3 diffuse_of_means(metal_means means, vec3 specular) {
    float rest = 1.0 - means.share;
    // Metal's share where the diffuse colour is: E[m (1 - m)]/E[1 - m].
    float covering = clamp((means.share - means.square) / max(rest, 1e-3), 0.0, means.share);
    vec3 own = mix(vec3(DIELECTRIC_F0), means.metal / max(means.share, 1e-3), covering);
    return max(means.colour - means.metal, vec3(0.0)) * max(1.0 - own, vec3(0.0)) /
           max(1.0 - specular, vec3(0.05));
}

// The mean of c^2 m (1 - m), which tells half metal from metal beside paint. What it covers is
// taken to have the colour of the metal, and is no more than there is.
vec3 covered_by_metal(surface_point surface, map_area lobes) {
    if (METAL_MEANS == METAL_MEANS_NONE) {
        vec3 colour = material.base_colour.rgb * surface.colour.rgb *
                      filtered_base_colour(surface, lobes).rgb;
        return colour * colour * (material.metallic * (1.0 - material.metallic));
    }
    metal_means means = fetch_metal_means(surface, lobes);
    vec3 colour = means.metal / max(means.share, 1e-3);
    return colour * clamp(colour * (means.share - means.square), vec3(0.0),
                          max(means.colour - means.metal, vec3(0.0)));
}

// As wide as one lobe of the mean alpha.
void take_width(inout base_material base, surface_point surface) {
    if (WIDTHS_APART)
        base.width = width_of_means(fetch_width_means(surface));
}

// `lobes`: the area of the map of lobes. The mean of colours times metal's share, where the product
// of both means is that of neither metal nor what covers it: glTF 2.0, appendix B.2.
base_material filtered_material(surface_point surface, vec3 normal, map_area lobes) {
    base_material base;
    if (METAL_MEANS == METAL_MEANS_NONE) {
        base = assemble_material(
            surface, normal, filtered_base_colour(surface, lobes),
            filtered_texel(MAP_WIDTH, width_map, width_filtered, surface, lobes),
            filtered_texel(MAP_SPECULAR, specular_map, specular_filtered, surface, lobes).rgb);
        take_width(base, surface);
        return base;
    }
    base = assemble_material(surface, normal, vec4(1.0),
                             unfiltered_texel(MAP_WIDTH, width_map, surface), vec3(1.0));
    take_width(base, surface);
    metal_means means = fetch_metal_means(surface, lobes);
    base.specular = means.metal + DIELECTRIC_F0 * (1.0 - means.share);
    base.diffuse = diffuse_of_means(means, base.specular);
    return base;
}

#endif
