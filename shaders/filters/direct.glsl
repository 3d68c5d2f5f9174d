// One unfiltered sample of the maps: what every filter should average. The reference averages many
// of these.

#pragma variants CLOSED_SURFACE WAVES

#ifdef WAVES

#include "shading/waves/unfiltered_waves.glsl"

#else

#include "shading/unfiltered_maps.glsl"

#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#include "environment/sample.glsl"
#endif

struct appearance {
    base_material base;
    vec3 emission;
    bool kept;
    vec3 normal;      // in the tangent frame
    float lobe_count; // lobes evaluated for one light
    float level;      // MIP level, 0: the maps themselves
};

appearance fetch_appearance(surface_point surface) {
    appearance result;
    result.base = unfiltered_material(surface);
    result.normal = result.base.normal;
    result.kept = !ALPHA_MASK || is_kept(unfiltered_base_colour(surface).a, surface);
    result.emission = vec3(0.0);
    if (EMISSION)
        result.emission = unfiltered_texel(MAP_EMISSIVE, emissive_map, surface).rgb;
    result.lobe_count = float(LOBE_COUNT);
    result.level = 0.0;
    return result;
}

#include "shading/lights/no_gathering.glsl"

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    return evaluate_base_material(fetched.base, surface.outgoing, incoming);
}

float fetch_occlusion(surface_point surface) {
    return unoccluded(unfiltered_texel(MAP_OCCLUSION, occlusion_map, surface).r);
}

#ifdef ENVIRONMENT
vec3 reflect_environment(appearance fetched, surface_point surface) {
    if (ENVIRONMENT_METHOD == ENVIRONMENT_REFERENCE)
        return sampled_environment(surface, fetched.base);
    return reflect_base_material(surface, fetched.base, fetched.base.normal);
}
#endif

#endif
