#ifndef LOBE_SHADING_GLSL
#define LOBE_SHADING_GLSL

// What a host calls, whatever the filter. Included after it.

#include "shading/colours/colour_normals.glsl"
#ifdef LOBE_ENVIRONMENT
#include "environment/integral.glsl"
#endif

#define lobe_appearance appearance

// The appearance of the surface's footprint. `kept` is false where a mask cuts the surface away,
// `normal` is the mean of the texels' (in the tangent frame). What follows is about the surface
// that was fetched last.
lobe_appearance lobe_fetch(lobe_surface surface) {
    fetch_colour_normals(surface);
    return fetch_appearance(surface);
}

// Fetches for up to four lights at once, which is faster than one at a time where a filter fetches
// for lights: lobe_maps_parameters.lights_at_once of them. `towards`: unit, in the world; those
// that are not used may be anything.
void lobe_gather(inout lobe_appearance fetched, lobe_surface surface, vec3 towards[4]) {
    vec3 incoming[4];
    for (int i = 0; i < 4; ++i)
        incoming[i] = towards[i] * surface.world_from_tangent;
    gather_lights(fetched, surface, incoming);
}

// Reflectance times cosine for light `index` of those gathered last. Its product with the
// irradiance that arrives perpendicular to that direction is the reflected radiance. No shadow is
// in it: the host multiplies by its own.
vec3 lobe_evaluate_gathered(lobe_appearance fetched, lobe_surface surface, vec3 towards,
                            uint index) {
    vec3 incoming = towards * surface.world_from_tangent;
    return add_colour_normals(evaluate_appearance(fetched, surface, incoming, index), surface,
                              incoming);
}

// Both for one light.
vec3 lobe_evaluate(inout lobe_appearance fetched, lobe_surface surface, vec3 towards) {
    lobe_gather(fetched, surface, vec3[4](towards, towards, towards, towards));
    return lobe_evaluate_gathered(fetched, surface, towards, 0u);
}

// The radiance that the material emits itself.
vec3 lobe_emission(lobe_appearance fetched) {
    return EMISSION ? material.emissive.rgb * fetched.emission : vec3(0.0);
}

#ifdef LOBE_ENVIRONMENT
// The radiance that is reflected of the environment, with the material's own occlusion.
vec3 lobe_integrate_environment(inout lobe_appearance fetched, lobe_surface surface) {
    return environment_light(fetched, surface);
}
#endif

#endif
