// The mean normal's length widens the lobes about it (Toksvig 2005, Mipmapping Normal Maps): the
// more the normals vary, the shorter their mean. The Lambert part is linear in the normal and uses
// it unnormalised.
//
// Widths are averaged as concentrations. Variances 1/kappa are what adds up, but averaging them
// lets the broadest texels dominate, and highlights lose their peaks. Relative L2 error against 36
// samples, with concentrations and with variances: checkerboard 0.366, 0.641; photographed metal on
// a plane 0.266, 0.643, rock 0.135, 0.180, bark 0.102, 0.152, brick 0.120, 0.135.

#include "shading/averaged_maps.glsl"

#include "shading/lights/no_gathering.glsl"

appearance fetch_appearance(surface_point surface) {
    return fetch_averaged_appearance(surface, surface);
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    return evaluate_base_material(widened_material(fetched), fetched.mean_normal, surface.outgoing,
                                  incoming);
}

#ifdef ENVIRONMENT
vec3 reflect_environment(appearance fetched, surface_point surface) {
    return reflect_base_material(surface, widened_material(fetched), fetched.mean_normal);
}
#endif
