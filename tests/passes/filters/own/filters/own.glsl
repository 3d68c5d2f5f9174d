// The shading of the test's own filter: a material shines in the mean colour of its map, whatever
// its normals, times what the knob "gain" says.

#include "shading/unfiltered_maps.glsl"

layout(constant_id = 100) const float GAIN = 0.0;

layout(set = 0, binding = 60, std140) uniform own_block { vec4 mean_colour; };

struct appearance {
    vec3 emission;
    float alpha;
    vec3 normal;
    float lobe_count;
    float level;
};

appearance fetch_appearance(surface_point surface) {
    return appearance(vec3(0.0), 1.0, vec3(0.0, 0.0, 1.0), 0.0, 0.0);
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    return GAIN * mean_colour.rgb;
}

float fetch_occlusion(surface_point surface) {
    return 1.0;
}

#ifdef ENVIRONMENT
vec3 reflect_environment(appearance fetched, surface_point surface) {
    return vec3(0.0);
}
#endif
