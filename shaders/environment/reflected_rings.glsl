#ifndef ENVIRONMENT_REFLECTED_RINGS_GLSL
#define ENVIRONMENT_REFLECTED_RINGS_GLSL

// Quadrature over what microfacets reflect towards a viewer: rings of half vectors about the
// normal.

#include "interface/environment/reflected_rings.h"
#include "lib/lobe/base_lobe.glsl"
#include "lib/microfacet/microfacet.glsl"

layout(constant_id = SPECIALISE_DISTRIBUTION) const uint DISTRIBUTION = DISTRIBUTION_GGX;
layout(constant_id = SPECIALISE_MASKING) const uint MASKING = DISTRIBUTION_GGX;

const int RINGS = REFLECTED_RINGS, AZIMUTHS = 8;

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

// Light that one half vector of a ring reflects.
struct reflected_light {
    vec2 parts; // factors of F_0 and F_90
    // The direction it comes from: its height, and how far it lies on the viewer's side.
    float height, aside;
};

// One of AZIMUTHS half vectors of a ring, which stands for its share of both halves of the circle.
//
// The azimuth range ends where incoming light would be below the horizon: cos(azimuth) =
// limit/across. With sin(azimuth/2) = m sin(tau), where m is its largest value, the integrand is
// smooth and periodic in tau, so that few points suffice.
reflected_light light_of_ring(vec3 ring, int i, float outgoing_cosine, float outgoing_sine,
                              float parameter, float masking_parameter) {
    float across = outgoing_sine * ring.y;
    float limit = outgoing_cosine * (0.5 / ring.x - ring.x);
    float m_squared = clamp(0.5 * (across - limit) / max(across, 1e-20), 0.0, 1.0);
    float density = normal_distribution(DISTRIBUTION, vec3(0.0, 0.0, 1.0),
                                        vec3(ring.y, 0.0, ring.x), parameter);
    float s = 0.5 - 0.5 * cos(PI / float(AZIMUTHS) * (float(i) + 0.5));
    float c = 1.0 - s;
    // Derivative of the azimuth by tau, for both halves of the circle.
    float weight =
        sqrt(m_squared * c / (c + (1.0 - m_squared) * s)) * 2.0 * PI / float(AZIMUTHS);
    float cosine = 1.0 - 2.0 * m_squared * s; // of the azimuth
    float facing = across * cosine + outgoing_cosine * ring.x;
    float incident_cosine = 2.0 * facing * ring.x - outgoing_cosine;
    float shadowed =
        masking_shadowing(MASKING, incident_cosine, outgoing_cosine, masking_parameter);
    float specular = microfacet_specular(vec3(1.0), density, shadowed, outgoing_cosine).x;
    // Walter, Marschner, Li, Torrance, 2007, Eq. 14: steradians of incidence per steradian of
    // half vectors.
    specular *= 4.0 * max(facing, 0.0) * weight * ring.z;
    float grazing = fifth_power(clamp(1.0 - facing, 0.0, 1.0));
    return reflected_light(specular * vec2(1.0 - grazing, grazing), incident_cosine,
                           2.0 * facing * ring.y * cosine - outgoing_sine);
}

#endif
