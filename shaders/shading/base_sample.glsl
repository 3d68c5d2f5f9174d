#ifndef BASE_SAMPLE_GLSL
#define BASE_SAMPLE_GLSL

// Directions drawn from what a base material reflects.

#include "shading/base_material.glsl"

// The height 1 - cos above the axis of a half vector drawn from a base lobe in proportion to
// D(h) <n, h> or rho(h).
float half_vector_height(float parameter, float number) {
    // Forms of 1 - cos without cancellation.
    switch (DISTRIBUTION) {
    case DISTRIBUTION_GGX: {
        float square = parameter * parameter * number / (1.0 - number);
        return square / (sqrt(1.0 + square) * (1.0 + sqrt(1.0 + square)));
    }
    case DISTRIBUTION_BECKMANN: {
        float square = -parameter * parameter * log(1.0 - number);
        return square / (sqrt(1.0 + square) * (1.0 + sqrt(1.0 + square)));
    }
    case DISTRIBUTION_BLINN_PHONG: {
        float exponent = MODEL == MODEL_MICROFACET ? parameter + 2.0 : parameter + 1.0;
        return -expm1(log(max(1.0 - number, 1e-30)) / exponent);
    }
    default:
        // Wood, 1994, Simulation of the von Mises Fisher Distribution, inverted.
        return clamp(-log(1.0 + number * expm1(-2.0 * parameter)) / max(parameter, 1e-6), 0.0, 2.0);
    }
}

// Its probability density per steradian of half vectors, by its height 1 - cos.
float half_vector_density(vec3 axis, vec3 halfway, float parameter) {
    if (MODEL == MODEL_HALF_VECTOR_LOBES || DISTRIBUTION == DISTRIBUTION_VMF)
        return half_vector_lobe(DISTRIBUTION, halfway, axis, parameter);
    return normal_distribution(DISTRIBUTION, axis, halfway, parameter) * dot(axis, halfway);
}

vec3 base_axis(base_material base, int lobe) {
    return MODEL == MODEL_MICROFACET
               ? base.normal
               : rotate_from_pole(base.normal, material.lobe_direction[lobe].xyz);
}

float base_parameter(base_material base, int lobe) {
    return MODEL == MODEL_MICROFACET ? widened_width(base) : widened_lobe_parameter(lobe, base);
}

int base_lobes() {
    return MODEL == MODEL_MICROFACET ? 1 : int(LOBE_COUNT);
}

const float LAMBERT_SHARE = 0.5;

// Part of the directions that are drawn for the Lambert part.
float lambert_share(base_material base) {
    if (!DIFFUSE && !CLOSED)
        return 0.0;
    bool has_lobes = MODEL == MODEL_MICROFACET || base.specular * lobes_colour() != vec3(0.0);
    return has_lobes ? LAMBERT_SHARE : 1.0;
}

vec3 direction_about(vec3 axis, float height, float angle) {
    float cosine = 1.0 - height;
    float sine = sqrt(max(height * (2.0 - height), 0.0));
    return rotate_from_pole(axis, vec3(sine * cos(angle), sine * sin(angle), cosine));
}

// Draws half of the directions for the Lambert part, the others from one of the lobes.
vec3 direction_from_material(base_material base, vec3 outgoing, vec3 numbers) {
    float angle = 2.0 * PI * numbers.y;
    if (numbers.z < lambert_share(base)) {
        float height = 1.0 - sqrt(1.0 - numbers.x);
        return direction_about(base.normal, height, angle);
    }
    float which = (numbers.z - lambert_share(base)) / max(1.0 - lambert_share(base), 1e-6);
    int lobe = min(int(which * float(base_lobes())), base_lobes() - 1);
    vec3 halfway = direction_about(
        base_axis(base, lobe), half_vector_height(base_parameter(base, lobe), numbers.x), angle);
    float cosine = dot(outgoing, halfway);
    // Facets that face away reflect nothing.
    return cosine > 0.0 ? 2.0 * cosine * halfway - outgoing : vec3(0.0, 0.0, -1.0);
}

float material_density(base_material base, vec3 outgoing, vec3 incoming) {
    vec3 halfway = half_vector(incoming, outgoing);
    float jacobian = 4.0 * max(dot(outgoing, halfway), 1e-6);
    float sum = 0.0;
    for (int i = 0; i < base_lobes(); ++i)
        sum += half_vector_density(base_axis(base, i), halfway, base_parameter(base, i)) / jacobian;
    sum *= (1.0 - lambert_share(base)) / float(base_lobes());
    return sum + lambert_share(base) * INVERSE_PI * max(dot(base.normal, incoming), 0.0);
}

#endif
