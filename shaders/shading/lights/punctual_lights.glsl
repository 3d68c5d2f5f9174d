#ifndef PUNCTUAL_LIGHTS_GLSL
#define PUNCTUAL_LIGHTS_GLSL

// The lights that a pass draws, sorted: directional, point, spot.

#include "interface/light.h"
#include "lib/light/light.glsl"
#include "shading/pixel.glsl"

layout(constant_id = SPECIALISE_DIRECTIONAL_LIGHTS) const bool DIRECTIONAL_LIGHTS = false;
layout(constant_id = SPECIALISE_POINT_LIGHTS) const bool POINT_LIGHTS = false;
layout(constant_id = SPECIALISE_SPOT_LIGHTS) const bool SPOT_LIGHTS = false;

layout(set = 0, binding = 2, std140) uniform light_block { light lights[LIGHTS_PER_PASS]; };

light light_at(uint i) {
    return lights[i];
}

uint light_count() {
    return (DIRECTIONAL_LIGHTS ? frame.directional_count : 0u) +
           (POINT_LIGHTS ? frame.point_count : 0u) + (SPOT_LIGHTS ? frame.spot_count : 0u);
}

bool is_directional(uint i) {
    return DIRECTIONAL_LIGHTS && (!(POINT_LIGHTS || SPOT_LIGHTS) || i < frame.directional_count);
}

bool is_spot(uint i) {
    return SPOT_LIGHTS && (!(DIRECTIONAL_LIGHTS || POINT_LIGHTS) ||
                           i >= frame.directional_count + frame.point_count);
}

// Unit direction from a point to light `i`, in the world; of no length at the light itself.
vec3 light_direction(uint i, vec3 position) {
    if (!POINT_LIGHTS && !SPOT_LIGHTS)
        return light_at(i).direction.xyz;
    vec3 offset = light_at(i).position.xyz - position;
    vec3 towards = offset * inversesqrt(max(dot(offset, offset), LIGHT_DISTANCE_SQUARED_MINIMUM));
    return is_directional(i) ? light_at(i).direction.xyz : towards;
}

// Irradiance of light `i` at a point, perpendicular to `direction`, which points to it.
vec3 light_irradiance(uint i, vec3 position, vec3 direction) {
    float attenuation = 1.0;
    if (POINT_LIGHTS || SPOT_LIGHTS) {
        vec3 offset = light_at(i).position.xyz - position;
        attenuation = is_directional(i)
                          ? 1.0
                          : distance_attenuation(dot(offset, offset), light_at(i).position.w);
    }
    if (SPOT_LIGHTS && is_spot(i))
        attenuation *= cone_attenuation(direction, light_at(i).direction.xyz, light_at(i).cone.x,
                                        light_at(i).cone.y);
    return light_at(i).intensity.rgb * attenuation;
}

#endif
