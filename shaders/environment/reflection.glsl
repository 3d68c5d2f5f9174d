#ifndef ENVIRONMENT_REFLECTION_GLSL
#define ENVIRONMENT_REFLECTION_GLSL

// What a base material reflects of the environment.

#include "environment/microfacets.glsl"

// ---------------------------------------------------------------------------------------------
// Lambert's part

// The albedo of what microfacets let through: 1 - F = (1 - F0) (1 - (1 - c)^5).
vec3 let_through(surface_point surface, base_material base) {
    if (MODEL != MODEL_MICROFACET)
        return base.diffuse;
    vec4 albedo = albedo_of(dot(base.normal, surface.outgoing), base.width);
    return diffuse_albedo(albedo, base.diffuse, base.specular, vec3(1.0));
}

vec3 reflect_lambert(surface_point surface, base_material base, vec3 mean_normal) {
    return let_through(surface, base) * irradiance_above(surface, mean_normal);
}

// ---------------------------------------------------------------------------------------------
// A base material

vec3 reflect_base_specular(surface_point surface, base_material base) {
    if (MODEL == MODEL_MICROFACET) {
        float width = widened_width(base);
        return reflect_microfacets(surface, base_half_vectors(base.normal, width, surface.outgoing),
                                   base.specular, width);
    }
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i) {
        vec3 axis = rotate_from_pole(base.normal, material.lobe_direction[i].xyz);
        float parameter = widened_lobe_parameter(i, base);
        sum += material.lobe_colour[i].rgb *
               reflect_half_vectors(surface, base_half_vectors(axis, parameter, surface.outgoing));
    }
    return base.specular * sum;
}

vec3 reflect_base_material(surface_point surface, base_material base, vec3 mean_normal) {
    vec3 sum = reflect_base_specular(surface, base);
    if (DIFFUSE)
        sum += reflect_lambert(surface, base, mean_normal);
    return sum;
}

#endif
