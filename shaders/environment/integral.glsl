#ifndef ENVIRONMENT_INTEGRAL_GLSL
#define ENVIRONMENT_INTEGRAL_GLSL

// The exact integral over an environment: every texel of the cube (of the level that is bound, see
// passes/environment/light.c) is treated as a directional light.
// Included after the filter, whose functions evaluate each light.

#include "environment/environment.glsl"
#include "lib/light/cube_texel.glsl"

struct environment_texel {
    vec3 direction;  // in the tangent frame
    vec3 irradiance; // perpendicular to it
};

// Texel `index`, counted through all six faces in order; no irradiance past the last one.
environment_texel texel_light(surface_point surface, mat3 tangent_from_environment, int index) {
    int size = textureSize(environment_faces, 0).x;
    int face = index / (size * size);
    ivec2 texel = ivec2(index % size, (index / size) % size);
    environment_texel light = environment_texel(vec3(0.0, 0.0, -1.0), vec3(0.0));
    if (face >= 6)
        return light;
    light.direction = tangent_from_environment * cube_texel_direction(face, texel, size);
    light.irradiance = texelFetch(environment_faces, ivec3(texel, face), 0).rgb *
                       (environment.intensity * cube_texel_solid_angle(texel, size));
    return light;
}

// Four texels at once, for which LIGHTS_AT_ONCE must be 4.
vec3 integrated_environment(inout appearance fetched, surface_point surface) {
    mat3 environment_from_tangent =
        mat3(to_environment(surface, vec3(1.0, 0.0, 0.0)),
             to_environment(surface, vec3(0.0, 1.0, 0.0)),
             to_environment(surface, vec3(0.0, 0.0, 1.0)));
    mat3 tangent_from_environment = transpose(environment_from_tangent);
    int size = textureSize(environment_faces, 0).x;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 6 * size * size; i += 4) {
        environment_texel lights[4];
        vec3 incoming[4];
        for (int k = 0; k < 4; ++k) {
            lights[k] = texel_light(surface, tangent_from_environment, i + k);
            incoming[k] = lights[k].direction;
        }
        gather_lights(fetched, surface, incoming);
        for (int k = 0; k < 4; ++k)
            sum += lights[k].irradiance *
                   add_colour_normals(
                       evaluate_appearance(fetched, surface, incoming[k], uint(k)), surface,
                       incoming[k]);
    }
    return sum;
}

// The radiance that the footprint reflects of the environment, by the chosen method.
vec3 environment_light(inout appearance fetched, surface_point surface) {
    vec3 reflected = ENVIRONMENT_METHOD == ENVIRONMENT_EXACT
                         ? integrated_environment(fetched, surface)
                         : add_colour_normals_of_environment(
                               reflect_environment(fetched, surface), surface);
    return fetch_occlusion(surface) * reflected;
}

#endif
