#ifndef WIDTH_MEANS_GLSL
#define WIDTH_MEANS_GLSL

// How wide the base lobes of a footprint are where their map lies on the surface otherwise than the
// normals do (maps/width_means.comp): maps of lobes hold lobes of one width. Both
// are taken to vary independently, as details that repeat across a worn sheet do.

#include "shading/filtered_maps.glsl"
#include "lib/lobe/plane_lobe.glsl"

layout(LOBE_DESCRIPTOR(59)) uniform sampler2DArray width_means_map;

// Means over a footprint, of which each lobe counts as much as it mirrors.
struct width_means {
    float sharpness;     // of 1 / sqrt(v), v the variance in the Lambert plane
    float variance;      // of v
    float complement;    // of 1 - |r|
    float concentration; // of kappa
    float alpha;
    float alpha_square;
};

// Of the pixel, for what is shaded lobe by lobe.
width_means drawn_widths;

width_means means_of_layers(vec4 lobes, vec4 microfacets) {
    float scale = 1.0 / max(lobes.w, 1e-6);
    lobes *= scale;
    microfacets *= scale;
    return width_means(lobes.x, lobes.y, lobes.z, microfacets.x, microfacets.y, microfacets.z);
}

// Of one base lobe.
float variance_in_plane(float parameter) {
    return BASE_AS_LOBE ? plane_variance(DISTRIBUTION_VMF,
                                         base_lobe_concentration(DISTRIBUTION, parameter))
                        : plane_variance(DISTRIBUTION, parameter);
}

// The layers of the map of a single width. `parameter`: of the distribution, normals inside a texel
// included.
void layers_of_width(float parameter, float mirrored, out vec4 lobes, out vec4 microfacets) {
    float concentration = base_lobe_concentration(DISTRIBUTION, parameter);
    float variance = variance_in_plane(parameter);
    float square = 2.0 / max(concentration, 1.0);
    lobes = mirrored * vec4(inversesqrt(variance), variance,
                            mean_resultant_complement(concentration), 1.0);
    microfacets = mirrored * vec4(concentration, sqrt(square), square, 1.0);
}

float parameter_of_factor(float factor) {
    return convolved(microfacet_parameter(DISTRIBUTION, material.roughness * factor));
}

width_means fetch_width_means(surface_point surface) {
    map_area area = area_of(MAP_WIDTH, vec2(textureSize(width_map, 0)), surface);
    vec4 lobes = vec4(0.0), microfacets = vec4(0.0);
    for (uint i = 0u; i < probes_of(area); ++i) {
        lobes += fetch_probe(width_means_map, WIDTH_LAYER_LOBES, area, i);
        microfacets += fetch_probe(width_means_map, WIDTH_LAYER_MICROFACETS, area, i);
    }
    if (may_see_level_0(MAP_WIDTH) && area.level < 1.0) {
        vec4 finest_lobes, finest_microfacets;
        layers_of_width(parameter_of_factor(base_texel(width_map, area.centre).g), lobes.w,
                        finest_lobes, finest_microfacets);
        lobes = mix(finest_lobes, lobes, area.level);
        microfacets = mix(finest_microfacets, microfacets, area.level);
    }
    return means_of_layers(lobes, microfacets);
}

// The parameter of one lobe that stands for all.
float width_of_means(width_means means) {
    return base_lobe_of_concentration(DISTRIBUTION, 2.0 / max(means.alpha * means.alpha, 1e-6));
}

// In the plane, of the width that lobes have in their maps.
float own_variance() {
    return variance_in_plane(parameter_of_factor(material.width_factor));
}

void draw_widths(surface_point surface) {
    if (WIDTHS_APART)
        drawn_widths = fetch_width_means(surface);
}

// What a variance of lobes projected onto the surface lacks. All directions alike have 1/4.
float projected_variance_lacking() {
    return WIDTHS_APART ? min(drawn_widths.variance, 0.25) - min(own_variance(), 0.25) : 0.0;
}

#endif
