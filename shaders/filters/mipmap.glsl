// The naive way: normals and concentrations are averaged like colours, and the averages are taken
// for those of one texel (Xu et al. 2017, section 5.2, naive MIP-mapping).

#include "filtered_maps.glsl"
#include "lib/characteristic_vector.glsl"

layout(constant_id = SPECIALISE_MIXTURE) const bool AVERAGED = false;

// xyz: mean normal; w: mean of the concentration of microfacets, or of the factor of the lobes'
// widths (see parameter_averaging.comp).
layout(set = 0, binding = 16) uniform sampler2D parameter_map;

struct appearance {
    base_material base;
    vec3 emission;
    float alpha;
    vec3 normal;
    float lobe_count;
    float level;
};

// What parameter_averaging.comp averages, of one texel; and back.
float averaged_width(base_material base) {
    return MODEL == MODEL_MICROFACET ? base_lobe_concentration(DISTRIBUTION, base.width)
                                     : base.width;
}

float width_from_average(float average) {
    if (MODEL != MODEL_MICROFACET || DISTRIBUTION == DISTRIBUTION_VMF)
        return average;
    return DISTRIBUTION == DISTRIBUTION_BLINN_PHONG ? average - 1.0 : sqrt(2.0 / average);
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    result.level = 0.0;
    vec3 normal = unfiltered_normal(surface);
    float width = 0.0;
    if (AVERAGED) {
        map_area area = lobe_area(surface);
        result.level = area.level;
        vec4 mean = vec4(0.0);
        for (uint i = 0u; i < PROBES; ++i)
            mean += textureLod(parameter_map, probe_position(area, i), max(area.level - 1.0, 0.0));
        mean /= float(PROBES);
        if (area.level < 1.0) {
            base_material base = unfiltered_material(surface);
            vec4 own = vec4(base.normal, averaged_width(base));
            mean = mix(own, mean, area.level);
        }
        normal = mean_direction(mean.xyz, vec3(0.0, 0.0, 1.0));
        width = mean.w;
    }
    result.base = filtered_material(surface, normal);
    if (AVERAGED)
        result.base.width = width_from_average(width);
    result.normal = normal;
    result.alpha = 1.0;
    if (ALPHA_MASK)
        result.alpha = filtered_base_colour(surface).a * material.base_colour.a * surface.colour.a;
    result.emission = EMISSION ? filtered_emission(surface) : vec3(0.0);
    result.lobe_count = float(LOBE_COUNT);
    return result;
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    return evaluate_base_material(fetched.base, surface.outgoing, incoming);
}
