#version 460
#extension GL_GOOGLE_include_directive : require

// Shades a pixel under punctual lights, from the appearance that the filter fetches there: a sum
// of parts (say, lobes), each of which is fetched and then shaded under every light. The build
// makes one variant of this shader for each file in filters/. What such a file brings:
//
//   struct appearance                           with emission, alpha, normal, lobe_count, level
//   appearance fetch_appearance(surface_point)  what all parts share
//   bool has_part(appearance)                   whether there is one more
//   void next_part(inout appearance)            fetches it
//   vec3 evaluate_part(appearance, surface_point, vec3 incoming)
//                                               its reflectance times cosine for one direction

#include "filter.glsl"
#include "interface/light.h"
#include "lib/light.glsl"

layout(set = 0, binding = 2, std430) readonly buffer light_block { light lights[]; };

layout(location = 0) out vec4 radiance_out;
#ifdef AOV
layout(location = 1) out vec4 normal_depth_out;
layout(location = 2) out vec2 lobes_level_out;
#endif

// Radiance reflected from one light: `incoming` is the unit direction to it in the world.
vec3 reflected(appearance part, surface_point surface, vec3 incoming, vec3 irradiance) {
    return irradiance * evaluate_part(part, surface, incoming * surface.world_from_tangent);
}

// Radiance that one part of the appearance reflects from all lights.
vec3 reflected_from_lights(appearance part, surface_point surface) {
    vec3 sum = vec3(0.0);
    uint next = 0u;
    if (DIRECTIONAL_LIGHTS) {
        for (uint end = next + frame.directional_count; next < end; ++next)
            sum += reflected(part, surface, lights[next].direction.xyz, lights[next].intensity.rgb);
    }
    if (POINT_LIGHTS) {
        for (uint end = next + frame.point_count; next < end; ++next) {
            vec3 to_light = lights[next].position.xyz - surface.world_position;
            float attenuation = distance_attenuation(dot(to_light, to_light),
                                                     lights[next].position.w);
            sum += reflected(part, surface, normalize(to_light),
                             lights[next].intensity.rgb * attenuation);
        }
    }
    if (SPOT_LIGHTS) {
        for (uint end = next + frame.spot_count; next < end; ++next) {
            vec3 to_light = lights[next].position.xyz - surface.world_position;
            vec3 incoming = normalize(to_light);
            float attenuation =
                distance_attenuation(dot(to_light, to_light), lights[next].position.w) *
                cone_attenuation(incoming, lights[next].direction.xyz, lights[next].cone.x,
                                 lights[next].cone.y);
            sum += reflected(part, surface, incoming, lights[next].intensity.rgb * attenuation);
        }
    }
    return sum;
}

void main() {
    surface_point surface = read_surface();
    appearance fetched = fetch_appearance(surface);
    if (ALPHA_MASK && fetched.alpha < material.emissive.w)
        discard;

    vec3 value = vec3(0.0);
    // Views and AOVs count the parts as well.
    while (has_part(fetched)) {
        next_part(fetched);
        if (VIEW == VIEW_RADIANCE)
            value += reflected_from_lights(fetched, surface);
    }
    if (EMISSION && VIEW == VIEW_RADIANCE)
        value += material.emissive.rgb * fetched.emission;
    if (VIEW == VIEW_LOBES)
        value = vec3(fetched.lobe_count);
    if (VIEW == VIEW_LEVEL)
        value = vec3(fetched.level);
    radiance_out = vec4(value, 1.0);

#ifdef AOV
    vec3 world_normal = normalize(surface.world_from_tangent * fetched.normal);
    float depth = dot(frame.axis.xyz, surface.world_position) - frame.axis.w;
    normal_depth_out = vec4(world_normal, depth);
    lobes_level_out = vec2(fetched.lobe_count, fetched.level);
#endif
}
