#ifndef WIDTH_MEANS_GLSL
#define WIDTH_MEANS_GLSL

// How wide the base lobes of a footprint are where their map lies on the surface otherwise than the
// normals do (maps/width_means.comp): maps of lobes hold lobes of one width. Both
// are taken to vary independently, as details that repeat across a worn sheet do.

#include "shading/filtered_maps.glsl"
#include "lib/lobe/width_layers.glsl"

layout(LOBE_DESCRIPTOR(59)) uniform sampler2DArray width_means_map;

// Means over a footprint, of which each lobe counts as much as it mirrors.
struct width_means {
    // In the Lambert plane, where broad lobes have more mass. As in bins of `moments`, the first
    // two count by that, too.
    float sharpness; // of 1 / sqrt(v), v the variance
    float variance;  // of v
    float mass;
    float complement;    // of 1 - |r|
    float concentration; // of kappa
    float alpha;
    float alpha_square;
};

// Of the pixel, for what is shaded lobe by lobe.
width_means drawn_widths;

width_means means_of_layers(width_layers layers) {
    float scale = 1.0 / max(layers.microfacets.w, 1e-6), per_mass = 1.0 / max(layers.lobes.w, 1e-6);
    vec3 microfacets = scale * layers.microfacets.xyz;
    return width_means(per_mass * layers.lobes.x, per_mass * layers.lobes.y, scale * layers.lobes.w,
                       scale * layers.lobes.z, microfacets.x, microfacets.y, microfacets.z);
}

float parameter_of_factor(float factor) {
    return convolved(microfacet_parameter(DISTRIBUTION, material.roughness * factor));
}

width_means fetch_width_means(surface_point surface) {
    map_area area = area_of(MAP_WIDTH, vec2(textureSize(width_map, 0)), surface);
    width_layers sum = width_layers(vec4(0.0), vec4(0.0));
    for (uint i = 0u; i < probes_of(area); ++i) {
        sum.lobes += fetch_probe(width_means_map, WIDTH_LAYER_LOBES, area, i);
        sum.microfacets += fetch_probe(width_means_map, WIDTH_LAYER_MICROFACETS, area, i);
    }
    if (may_see_level_0(MAP_WIDTH) && area.share < 1.0) {
        float mirrored = sum.microfacets.w;
        width_layers finest =
            layers_of_width(DISTRIBUTION, BASE_AS_LOBE,
                            parameter_of_factor(base_texel(width_map, area.centre).g));
        sum.lobes = mix(mirrored * finest.lobes, sum.lobes, area.share);
        sum.microfacets = mix(mirrored * finest.microfacets, sum.microfacets, area.share);
    }
    return means_of_layers(sum);
}

// The parameter of one lobe that stands for all.
float width_of_means(width_means means) {
    return base_lobe_of_concentration(DISTRIBUTION, 2.0 / max(means.alpha * means.alpha, 1e-6));
}

// In the plane, of the width that lobes have in their maps.
float own_width_in_plane(out float mass) {
    return width_in_plane(DISTRIBUTION, BASE_AS_LOBE, parameter_of_factor(material.width_factor),
                          mass);
}

void draw_widths(surface_point surface) {
    if (WIDTHS_APART)
        drawn_widths = fetch_width_means(surface);
}

// What a variance of lobes projected onto the surface lacks. All directions alike have 1/4. The
// mean is not by the lobes' masses, which are 1 + 2 v of GGX, and about 1 of the others.
float projected_variance_lacking() {
    if (!WIDTHS_APART)
        return 0.0;
    float mean = !BASE_AS_LOBE && DISTRIBUTION == DISTRIBUTION_GGX ? 0.5 * (drawn_widths.mass - 1.0)
                                                                   : drawn_widths.variance;
    float mass;
    return min(mean, 0.25) - min(own_width_in_plane(mass), 0.25);
}

#endif
