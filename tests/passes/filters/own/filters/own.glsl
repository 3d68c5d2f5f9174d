// The shading of the test's own filter: a material emits the mean colour of its map, whatever its
// normals, times the knob "gain", with red and blue exchanged if the knob "order" requests it.

#include "shading/unfiltered_maps.glsl"

layout(constant_id = 100) const bool SHINES = false;
layout(constant_id = 200) const bool REVERSED = false;

layout(set = 0, binding = FILTER_KNOB_BINDING, std140) uniform filter_knob_block {
    float padding;
    float gain;
};

layout(set = 0, binding = 60, std140) uniform own_block { vec4 mean_colour; };

struct appearance {
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

appearance fetch_appearance(surface_point surface) {
    return appearance(vec3(0.0), true, vec3(0.0, 0.0, 1.0), 0.0, 0.0);
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    return SHINES ? gain * (REVERSED ? mean_colour.bgr : mean_colour.rgb) : vec3(0.0);
}

float fetch_occlusion(surface_point surface) {
    return 1.0;
}

#ifdef ENVIRONMENT
vec3 reflect_environment(appearance fetched, surface_point surface) {
    return vec3(0.0);
}
#endif
