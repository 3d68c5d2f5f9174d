// The naive way: normals and concentrations are averaged like colours, and the averages are used as
// if they were one texel's (Xu et al. 2017, section 5.2, naive MIP-mapping).

#include "shading/averaged_maps.glsl"

#include "shading/lights/no_gathering.glsl"

appearance fetch_appearance(surface_point surface) {
    return fetch_averaged_appearance(surface, surface);
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    return evaluate_base_material(fetched.base, surface.outgoing, incoming);
}

#ifdef ENVIRONMENT
vec3 reflect_environment(appearance fetched, surface_point surface) {
    return reflect_base_material(surface, fetched.base, fetched.base.normal);
}
#endif
