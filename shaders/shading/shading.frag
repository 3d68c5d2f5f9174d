#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#pragma variants ENVIRONMENT AOV

// Shades a pixel under punctual lights from the appearance that the filter fetches. The build makes
// one variant of this shader for each file in filters/. Such a file defines:
//
//   struct appearance                           with emission, kept, normal, lobe_count, level
//   appearance fetch_appearance(surface_point)  the appearance of the pixel's footprint
//   void gather_lights(inout appearance, surface_point, vec3 incoming[4])
//                                               prepares up to LIGHTS_AT_ONCE directions, so
//                                               that all of them share the same fetches
//   vec3 evaluate_appearance(appearance, surface_point, vec3 incoming, uint light)
//                                               reflectance times cosine for one of those
//
// and, if ENVIRONMENT is defined (light from all directions as well):
//   vec3 reflect_environment(inout appearance, surface_point)
//                                               reflected radiance of the environment
//   float fetch_occlusion(surface_point)        fraction of it that reaches the footprint

#include "shading/pixel.glsl"
#include "filter.glsl"
#include "shading/lights/punctual_lights.glsl"
#include "shading/shadows/shadow_maps.glsl"
#include "shading/colours/colour_normals.glsl"
#ifdef ENVIRONMENT
#include "environment/integral.glsl"
#endif

layout(location = 0) out vec4 radiance_out;
#ifdef AOV
layout(location = 1) out vec4 normal_depth_out;
layout(location = 2) out vec2 lobes_level_out;
#endif

vec3 incoming_direction(uint i, surface_point surface) {
    return light_direction(i, mesh.position) * surface.world_from_tangent;
}

// Radiance from all lights, LIGHTS_AT_ONCE at a time.
vec3 reflected_radiance(inout appearance fetched, surface_point surface, drawn_plane plane) {
    vec3 sum = vec3(0.0);
    uint count = light_count();
    for (uint first = 0u; first < count; first += LIGHTS_AT_ONCE) {
        vec3 incoming[4];
        incoming[0] = incoming_direction(first, surface);
        incoming[1] = LIGHTS_AT_ONCE > 1u ? incoming_direction(min(first + 1u, count - 1u), surface)
                                          : incoming[0];
        incoming[2] = LIGHTS_AT_ONCE > 2u ? incoming_direction(min(first + 2u, count - 1u), surface)
                                          : incoming[0];
        incoming[3] = LIGHTS_AT_ONCE > 3u ? incoming_direction(min(first + 3u, count - 1u), surface)
                                          : incoming[0];
        gather_lights(fetched, surface, incoming);
        for (uint i = 0u; i < LIGHTS_AT_ONCE && first + i < count; ++i) {
            vec3 direction = light_direction(first + i, mesh.position);
            vec3 irradiance = light_irradiance(first + i, mesh.position, direction);
            if (SHADOWS)
                irradiance *= light_visibility(first + i, mesh.position, direction, plane);
            vec3 own = direction * surface.world_from_tangent;
            sum += irradiance *
                   add_colour_normals(evaluate_appearance(fetched, surface, own, i), surface, own);
        }
    }
    return sum;
}

void main() {
    surface_point surface = read_surface();
    drawn_plane plane;
    if (SHADOWS)
        plane = plane_of_triangle();
    appearance fetched = fetch_appearance(surface);
    if (ALPHA_MASK && !DEFERRED && !fetched.kept)
        discard;

    fetch_colour_normals(surface);

    // Shades even for the views of lobes and levels, which count what shading used.
    vec3 value = vec3(0.0);
    if (DIRECTIONAL_LIGHTS || POINT_LIGHTS || SPOT_LIGHTS)
        value = reflected_radiance(fetched, surface, plane);
#ifdef ENVIRONMENT
    value += environment_light(fetched, surface);
#endif
    if (EMISSION && frame.first_light == 0u)
        value += material.emissive.rgb * fetched.emission;
    if (VIEW == VIEW_LOBES)
        value = vec3(fetched.lobe_count);
    if (VIEW == VIEW_LEVEL)
        value = vec3(fetched.level);
    radiance_out = vec4(value, DEPTH_AS_COVERAGE ? max(mesh.depth, 1e-30) : 1.0);

#ifdef AOV
    vec3 world_normal = normalize(surface.world_from_tangent * fetched.normal);
    normal_depth_out = vec4(world_normal, surface.depth);
    lobes_level_out = vec2(fetched.lobe_count, fetched.level);
#endif
}
