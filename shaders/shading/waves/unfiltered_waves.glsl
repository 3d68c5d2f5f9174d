#ifndef UNFILTERED_WAVES_GLSL
#define UNFILTERED_WAVES_GLSL

// One point of the waves: all layers together move the point and tilt its surface.

#include "shading/unfiltered_maps.glsl"
#include "shading/waves/waves.glsl"

vec2 displacement(vec2 point) {
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < WAVE_LAYERS; ++i)
        sum += wave_field(point, i, OCEAN_FIELD_PLACE).yz;
    return sum;
}

footprint_waves wave_slopes(surface_point surface, out float level) {
    vec2 seen = wave_point(surface.coordinates.xy), point = seen;
    for (int i = 0; WAVES_CHOPPY && i < WAVE_STEPS; ++i)
        point = seen - displacement(point);
    vec4 gradients = vec4(0.0);
    float shear = 0.0;
    for (uint i = 0u; i < WAVE_LAYERS; ++i) {
        gradients += wave_field(point, i, OCEAN_FIELD_GRADIENTS);
        shear += wave_field(point, i, OCEAN_FIELD_PLACE).w;
    }
    level = 0.0;
    return footprint_waves(displaced_slope_of(gradients, shear).slope, vec3(0.0));
}

float wave_height() {
    return 1.0;
}

base_material wave_material(surface_point surface) {
    return unfiltered_material(surface, vec3(0.0, 0.0, 1.0));
}

vec3 wave_emission(surface_point surface) {
    return unfiltered_texel(MAP_EMISSIVE, emissive_map, surface).rgb;
}

float fetch_occlusion(surface_point surface) {
    return unoccluded(unfiltered_texel(MAP_OCCLUSION, occlusion_map, surface).r);
}

#endif
