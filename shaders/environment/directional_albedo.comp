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
#include "lib/lobe/base_lobe.glsl"
#include "lib/microfacet/microfacet.glsl"

layout(constant_id = SPECIALISE_DISTRIBUTION) const uint DISTRIBUTION = DISTRIBUTION_GGX;
layout(constant_id = SPECIALISE_MASKING) const uint MASKING = DISTRIBUTION_GGX;

// One workgroup per row.
layout(local_size_x = DIRECTIONAL_ALBEDO_SIZE) in;

layout(set = 0, binding = 0) uniform writeonly image2D directional_albedo;

shared float row[DIRECTIONAL_ALBEDO_SIZE];

const int RINGS = 48, AZIMUTHS = 8;

// The midpoint rule on [0, 1] with points concentrated at both ends, where the integrand may bend:
//   s = t^3 (10 - 15 t + 6 t^2)
// x: a point, y: its weight.
vec2 crowded_point(int i, int count) {
    float t = (float(i) + 0.5) / float(count);
    float rest = t * (1.0 - t);
    return vec2(t * t * t * (10.0 + t * (6.0 * t - 15.0)), 30.0 * rest * rest / float(count));
}

// x: cosine, y: sine of the angle between normal and half vector, z: steradians per radian of
// azimuth. The angle's tangent is 2 alpha q/(1 - q^2), spread as the distribution is, up to the
// steepest half vector that reflects to above the horizon: halfway from the viewer to the horizon
// beyond.
vec3 ring_of_half_vectors(int i, float outgoing_cosine, float outgoing_sine, float alpha) {
    float steepest = (1.0 + outgoing_sine) / (outgoing_cosine * alpha);
    float last = steepest / (1.0 + sqrt(1.0 + steepest * steepest));
    vec2 point = crowded_point(i, RINGS);
    float q = last * point.x;
    float complement = (1.0 - q) * (1.0 + q);
    float tangent = 2.0 * alpha * q / complement;
    float slope = 2.0 * alpha * (1.0 + q * q) / (complement * complement);
    float cosine = inversesqrt(1.0 + tangent * tangent);
    float sine = tangent * cosine;
    return vec3(cosine, sine, sine * cosine * cosine * slope * last * point.y);
}

float fifth_power(float x) {
    float square = x * x;
    return square * square * x;
}

// Reflection by the half vectors of one ring, integrated over the azimuth: the factors of F_0 and
// F_90.
//
// The azimuth range ends where incoming light would be below the horizon: cos(azimuth) =
// limit/across. With sin(azimuth/2) = m sin(tau), where m is its largest value, the integrand is
// smooth and periodic in tau, so that few points suffice.
vec2 reflected_by_ring(vec3 ring, float outgoing_cosine, float outgoing_sine, float parameter,
                       float masking_parameter) {
    float across = outgoing_sine * ring.y;
    float limit = outgoing_cosine * (0.5 / ring.x - ring.x);
    float m_squared = clamp(0.5 * (across - limit) / max(across, 1e-20), 0.0, 1.0);
    float density = normal_distribution(DISTRIBUTION, vec3(0.0, 0.0, 1.0),
                                        vec3(ring.y, 0.0, ring.x), parameter);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < AZIMUTHS; ++i) {
        float s = 0.5 - 0.5 * cos(PI / float(AZIMUTHS) * (float(i) + 0.5));
        float c = 1.0 - s;
        // Derivative of the azimuth by tau, for both halves of the circle.
        float weight = sqrt(m_squared * c / (c + (1.0 - m_squared) * s)) * 2.0 * PI /
                       float(AZIMUTHS);
        float facing = across * (1.0 - 2.0 * m_squared * s) + outgoing_cosine * ring.x;
        float incident_cosine = 2.0 * facing * ring.x - outgoing_cosine;
        float shadowed =
            masking_shadowing(MASKING, incident_cosine, outgoing_cosine, masking_parameter);
        float specular = microfacet_specular(vec3(1.0), density, shadowed, outgoing_cosine).x;
        // Walter, Marschner, Li, Torrance, 2007, Eq. 14: steradians of incidence per steradian of
        // half vectors.
        specular *= 4.0 * max(facing, 0.0) * weight;
        float grazing = fifth_power(clamp(1.0 - facing, 0.0, 1.0));
        sum += specular * vec2(1.0 - grazing, grazing);
    }
    return ring.z * sum;
}

vec2 specular_parts(float outgoing_cosine, float roughness) {
    float outgoing_sine = sqrt((1.0 - outgoing_cosine) * (1.0 + outgoing_cosine));
    float alpha = alpha_from_roughness(roughness);
    float parameter = microfacet_parameter(DISTRIBUTION, roughness);
    float masking_parameter = microfacet_parameter(MASKING, roughness);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < RINGS; ++i)
        sum += reflected_by_ring(ring_of_half_vectors(i, outgoing_cosine, outgoing_sine, alpha),
                                 outgoing_cosine, outgoing_sine, parameter, masking_parameter);
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
