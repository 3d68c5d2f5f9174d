#ifndef LIB_LIGHT_GLSL
#define LIB_LIGHT_GLSL

// Punctual lights: Khronos Group, 2018, KHR_lights_punctual.

const float LIGHT_DISTANCE_SQUARED_MINIMUM = 1e-30;

// Inverse square, faded to zero at the range: max(min(1 - (d/range)^4, 1), 0) / d^2.
// inverse_range_squared is 0 for an unlimited light. 0 at the light itself (closer than 1e-15 m),
// where light has no direction and its irradiance no bound.
float distance_attenuation(float distance_squared, float inverse_range_squared) {
    float ratio = distance_squared * inverse_range_squared;
    float window = clamp(1.0 - ratio * ratio, 0.0, 1.0);
    return distance_squared < LIGHT_DISTANCE_SQUARED_MINIMUM ? 0.0 : window / distance_squared;
}

// Fade between the cones of a spot light, clamp(scale <spot, -l> + offset, 0, 1)^2, with
// scale = 1/max(0.001, cos inner - cos outer), offset = -scale cos outer.
// `spot` is where it points, `towards_light` where it is, both of unit length.
float cone_attenuation(vec3 towards_light, vec3 spot, float scale, float offset) {
    float fade = clamp(-dot(spot, towards_light) * scale + offset, 0.0, 1.0);
    return fade * fade;
}

#endif
