#ifndef FILTERED_WAVES_GLSL
#define FILTERED_WAVES_GLSL

// Waves under a pixel's footprint, from the moments of each layer (maps/wave_moments.comp). Layers
// are independent: means and covariances add. Closer than level 1, a layer shows its own texels.

// Microfacets become Gaussian slopes.
#define SLOPE_FILTER

#include "shading/colours/filtered_material.glsl"
#include "shading/waves/waves.glsl"
#include "lib/microfacet/slope_distribution.glsl"

layout(LOBE_DESCRIPTOR(FILTER_KNOB_BINDING), std140) uniform filter_knob_block {
    leadr_knobs filter_knobs;
};
layout(LOBE_DESCRIPTOR(16)) uniform sampler2DArray wave_moments;

struct wave_sums {
    vec4 first, second;
};

map_area wave_area(vec2 point, uint layer, surface_point surface) {
    float frequency = waves.frequency[layer];
    return area_over(point * frequency, wave_point(surface.coordinates_dx.xy) * frequency,
                     wave_point(surface.coordinates_dy.xy) * frequency,
                     vec2(textureSize(wave_fields, 0).xy), true);
}

vec2 layer_displacement(vec2 point, uint layer, surface_point surface) {
    map_area area = wave_area(point, layer, surface);
    vec2 mean =
        filtered_layer(wave_moments, area, WAVE_MAP_LAYERS * layer + WAVE_LAYER_PLACE).xy;
    return area.level < 1.0 ? mix(wave_field(point, layer, OCEAN_FIELD_PLACE).yz, mean, area.level)
                            : mean;
}

wave_sums layer_moments(vec2 point, uint layer, surface_point surface, out float level) {
    map_area area = wave_area(point, layer, surface);
    level = area.level;
    wave_sums filtered =
        wave_sums(filtered_layer(wave_moments, area, WAVE_MAP_LAYERS * layer + WAVE_LAYER_FIRST),
                  filtered_layer(wave_moments, area, WAVE_MAP_LAYERS * layer + WAVE_LAYER_SECOND));
    if (area.level >= 1.0)
        return filtered;
    displaced_slope own = displaced_slope_of(wave_field(point, layer, OCEAN_FIELD_GRADIENTS),
                                             wave_field(point, layer, OCEAN_FIELD_PLACE).w);
    return wave_sums(mix(first_wave_moments(own), filtered.first, area.level),
                     mix(second_wave_moments(own), filtered.second, area.level));
}

footprint_waves wave_slopes(surface_point surface, out float level) {
    vec2 seen = wave_point(surface.coordinates.xy), point = seen;
    for (int i = 0; WAVES_CHOPPY && i < WAVE_STEPS; ++i) {
        vec2 moved = vec2(0.0);
        for (uint k = 0u; k < WAVE_LAYERS; ++k)
            moved += layer_displacement(point, k, surface);
        point = seen - moved;
    }
    vec2 mean = vec2(0.0);
    vec3 covariance = vec3(0.0);
    for (uint i = 0u; i < WAVE_LAYERS; ++i) {
        wave_sums sums = layer_moments(point, i, surface, level);
        float area = max(sums.first.x, 1e-3);
        vec2 own = sums.first.yz / area;
        mean += own;
        covariance += covariance_of_moments(own, sums.second.xyz / area);
    }
    return footprint_waves(mean, covariance);
}

float wave_height() {
    return filter_knobs.height;
}

base_material wave_material(surface_point surface) {
    return filtered_material(surface, vec3(0.0, 0.0, 1.0), lobe_area(surface));
}

vec3 wave_emission(surface_point surface) {
    return filtered_emission(surface, lobe_area(surface));
}

#endif
