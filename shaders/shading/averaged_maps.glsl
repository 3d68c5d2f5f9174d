#ifndef AVERAGED_MAPS_GLSL
#define AVERAGED_MAPS_GLSL

// Fetching one mean normal and one mean width of a footprint, for filters that shade with them as
// if they were one texel's.

#include "shading/level_0.glsl"
#include "shading/mask.glsl"
#include "lib/lobe/characteristic_vector.glsl"

#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#endif

// xyz: mean normal; w: mean of the concentration of microfacets, or of the factor of the lobes'
// widths (see parameter_averaging.comp). A second layer: how much of them counts.
layout(LOBE_DESCRIPTOR(16)) uniform sampler2DArray parameter_map;

struct appearance {
    base_material base;
    vec3 mean_normal; // of any length up to one
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

// From a texel's width to the value that parameter_averaging.comp averages; and back.
float averaged_width(base_material base) {
    return MODEL == MODEL_MICROFACET ? base_lobe_concentration(DISTRIBUTION, base.width)
                                     : base.width;
}

float width_from_average(float average) {
    return MODEL == MODEL_MICROFACET ? base_lobe_of_concentration(DISTRIBUTION, average) : average;
}

// The mean of normals whose slopes follow the stretching of the map: the direction is that of the
// mean slope, and the variance grows as that of slopes.
vec3 stretched_mean(vec3 mean, surface_point surface) {
    if (!STRETCHED)
        return mean;
    float size = max(length(mean), 1e-4);
    float growth = 0.5 * (dot(surface.stretch[0], surface.stretch[0]) +
                          dot(surface.stretch[1], surface.stretch[1]));
    return stretched_normal(mean / size, surface) / (1.0 + growth * (1.0 / size - 1.0));
}

// Averages over the footprint: a normal of length at most one, and a width.
vec4 fetch_averages(map_area area, surface_point surface) {
    vec4 sum = filtered_layer(parameter_map, area, 0u);
    float kept = MASKED_LOBES ? filtered_layer(parameter_map, area, 1u).x : 1.0;
    sum *= per_kept(kept);
    sum.xyz = stretched_mean(sum.xyz, surface);
    if (WIDTHS_APART)
        sum.w = fetch_width_means(surface).concentration;
    if (may_see_level_0(lobe_map())) {
        level_0_normals normals = normals_of_level_0(surface, area, 1.0);
        float width = averaged_width(unfiltered_material(surface, normals.mean));
        sum = mix(sum, vec4(normals.mean, width), share_of_level_0(normals, area.share, kept));
    }
    sum.xyz = facing_normal(sum.xyz, surface);
    return sum;
}

// `seen`: where a mask and emission are read.
appearance fetch_averaged_appearance(surface_point surface, surface_point seen) {
    appearance result;
    map_area area = lobe_area(surface);
    vec4 averages = FILTERED_LOBES ? fetch_averages(area, surface) : vec4(0.0);
    result.normal = FILTERED_LOBES ? mean_direction(averages.xyz, vec3(0.0, 0.0, 1.0))
                                   : unfiltered_normal(surface);
    result.mean_normal = FILTERED_LOBES ? averages.xyz : result.normal;
    result.base = filtered_material(surface, result.normal, area);
    if (FILTERED_LOBES)
        result.base.width = width_from_average(averages.w);
    result.kept = !ALPHA_MASK || keeps_footprint(seen);
    result.emission = EMISSION ? filtered_emission(seen, lobe_area(seen)) : vec3(0.0);
    result.lobe_count = float(LOBE_COUNT);
    result.level = FILTERED_LOBES ? area.level : 0.0;
    return result;
}

// Widened by the length of the mean normal (Toksvig 2005): a length of one widens nothing.
base_material widened_material(appearance fetched) {
    base_material base = fetched.base;
    if (FILTERED_LOBES)
        base.variance += variance_of_mean_normal(length(fetched.mean_normal));
    return base;
}

#endif
