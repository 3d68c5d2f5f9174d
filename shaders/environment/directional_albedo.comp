#version 460
#extension GL_GOOGLE_include_directive : require

// The albedo of a microfacet distribution for each cosine to the viewer and each roughness: the
// integral of the reflectance times cosine (lib/microfacet/microfacet.glsl) over all incoming
// directions above the surface.
//   x, y: reflectance is F_0 x + F_90 y, Schlick's Fresnel term being F_0 (1 - f) + F_90 f with
//         f = (1 - <omega_i, omega_h>)^5;
//   z:    mean of f weighted by the cosine of incidence: what the Lambert part loses to F;
//   w:    mean of x + y weighted by the cosine to the viewer: the albedo for this roughness under
//         uniform light. The same for a whole row.
//
// The quadrature is the same for all distributions: 384 half vectors, error below 3e-4 everywhere.

#include "interface/environment/directional_albedo.h"
#include "environment/reflected_rings.glsl"

// One workgroup per row.
layout(local_size_x = DIRECTIONAL_ALBEDO_SIZE) in;

layout(set = 0, binding = 0) uniform writeonly image2D directional_albedo;

shared float row[DIRECTIONAL_ALBEDO_SIZE];

vec2 specular_parts(float outgoing_cosine, float roughness) {
    float outgoing_sine = sqrt((1.0 - outgoing_cosine) * (1.0 + outgoing_cosine));
    float alpha = alpha_from_roughness(roughness);
    float parameter = microfacet_parameter(DISTRIBUTION, roughness);
    float masking_parameter = microfacet_parameter(MASKING, roughness);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < RINGS; ++i) {
        vec3 ring = ring_of_half_vectors(i, outgoing_cosine, outgoing_sine, alpha);
        for (int j = 0; j < AZIMUTHS; ++j)
            sum += light_of_ring(ring, j, outgoing_cosine, outgoing_sine, parameter,
                                 masking_parameter).parts;
    }
    return sum;
}

// Mean of (1 - <omega_i, omega_h>)^5 over incoming directions, weighted by Lambert's law:
// <omega_i, omega_h> is the cosine of half the angle between omega_i and omega_o.
float diffuse_part(float outgoing_cosine) {
    const int elevations = 16, azimuths = 16;
    float outgoing_sine = sqrt((1.0 - outgoing_cosine) * (1.0 + outgoing_cosine));
    float sum = 0.0;
    for (int i = 0; i < elevations; ++i) {
        vec2 point = crowded_point(i, elevations);
        float across = outgoing_sine * sqrt((1.0 - point.x) * (1.0 + point.x));
        for (int j = 0; j < azimuths; ++j) {
            float between = across * cos(PI / float(azimuths) * (float(j) + 0.5)) +
                            outgoing_cosine * point.x;
            sum += 2.0 * point.x * point.y / float(azimuths) *
                   fifth_power(1.0 - sqrt(max(0.5 + 0.5 * between, 0.0)));
        }
    }
    return sum;
}

// With u the square root of the cosine: integral of 2 cos d cos = integral of 4 u^3 du, by the
// trapezoidal rule, divided by the rule's result for 1.
float mean_of_row() {
    float sum = 0.0, whole = 0.0;
    for (int i = 1; i < DIRECTIONAL_ALBEDO_SIZE; ++i) {
        float weight = float(i) * float(i) * float(i);
        weight *= i == DIRECTIONAL_ALBEDO_SIZE - 1 ? 0.5 : 1.0;
        sum += weight * row[i];
        whole += weight;
    }
    return sum / whole;
}

void main() {
    ivec2 texel = ivec2(gl_LocalInvocationID.x, gl_WorkGroupID.x);
    vec2 place = vec2(texel) / float(DIRECTIONAL_ALBEDO_SIZE - 1);
    float outgoing_cosine = max(place.x * place.x, COSINE_MINIMUM);
    vec2 parts = specular_parts(outgoing_cosine, place.y);
    row[texel.x] = parts.x + parts.y;
    barrier();
    imageStore(directional_albedo, texel,
               vec4(parts, diffuse_part(outgoing_cosine), mean_of_row()));
}
