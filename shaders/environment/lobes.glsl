#ifndef ENVIRONMENT_LOBES_GLSL
#define ENVIRONMENT_LOBES_GLSL

// What a lobe of half vectors reflects of the environment.

#include "shading/base_material.glsl"
#include "environment/environment.glsl"

const vec3 SURFACE_NORMAL = vec3(0.0, 0.0, 1.0);

bool sampled_by_grid() {
    return ENVIRONMENT_METHOD == ENVIRONMENT_SAMPLED;
}

// ---------------------------------------------------------------------------------------------
// Lobes

// Gaussian on the plane that touches the sphere at the axis.
half_vector_distribution gaussian_slopes(vec3 axis, vec3 first, vec3 second) {
    return half_vector_distribution(direction_lobe(axis, first, second), DISTRIBUTION_BECKMANN);
}

// A base lobe, by its own parameter.
half_vector_distribution base_half_vectors(vec3 axis, float parameter, vec3 outgoing) {
    float deviation = inversesqrt(base_lobe_concentration(DISTRIBUTION, parameter));
    uint kind = !BASE_AS_LOBE && DISTRIBUTION == DISTRIBUTION_GGX ? DISTRIBUTION_GGX
                                                                  : DISTRIBUTION_VMF;
    return half_vector_distribution(isotropic_lobe(axis, deviation, outgoing), kind);
}

half_vector_distribution round_half_vectors(vec3 axis, float concentration, vec3 outgoing) {
    return half_vector_distribution(
        isotropic_lobe(axis, inversesqrt(max(concentration, 1e-2)), outgoing), DISTRIBUTION_VMF);
}

// A sample of the lobe: a half vector, its weight (weights are not normalised), and the solid angle
// that it represents.
struct half_vector_sample {
    vec3 half_vector;
    float weight;
    float solid_angle;
};

// Dupuy et al., 2013, Linear Efficient Antialiased Displacement and Reflectance Mapping, Algorithm
// 1: a grid in units of standard deviations, on the plane that touches the sphere at the axis. Each
// sample reads the mean over its cell (variance 1/12 cells) with linear interpolation (variance 1/6
// cells). With N samples per side, this spacing makes these variances and that of the samples add
// up to one (to 1 %). For N = 5 it is 0.85; Dupuy et al. used 0.9.
float grid_spacing() {
    return 6.37 / (float(ENVIRONMENT_GRID) + 2.52);
}

half_vector_sample gaussian_sample(direction_lobe lobe, uint j, uint k) {
    float spacing = grid_spacing();
    vec2 place = spacing * (vec2(j, k) - 0.5 * (float(ENVIRONMENT_GRID) - 1.0));
    half_vector_sample result;
    result.half_vector = normalize(lobe.axis + place.x * lobe.first + place.y * lobe.second);
    result.weight = exp(-0.5 * dot(place, place));
    float cosine = dot(result.half_vector, lobe.axis);
    result.solid_angle = spacing * spacing * length(cross(lobe.first, lobe.second)) * cosine *
                         cosine * cosine;
    return result;
}

// GGX has no variance: points of equal probability, Walter, Marschner, Li, Torrance, 2007, Eqs. 35
// and 36, tan theta = alpha sqrt(u/(1 - u)), and a deviation is alpha/sqrt(2). Of a Gaussian they
// are at sqrt(-2 log(1 - u)) deviations: where it is due to varying normals (`spread`, [0, 1]), a
// lobe has no tails.
half_vector_sample ggx_sample(direction_lobe lobe, uint j, uint k, float spread) {
    float n = float(ENVIRONMENT_GRID);
    float u = (float(j) + 0.5) / n;
    float angle = 2.0 * PI * (float(k) + 0.5 * float(j & 1u)) / n;
    float ggx = sqrt(2.0 * u / (1.0 - u)), gaussian = sqrt(-2.0 * log(1.0 - u));
    float tangent = mix(ggx, gaussian, spread);
    half_vector_sample result;
    result.half_vector = normalize(lobe.axis + tangent * (cos(angle) * lobe.first +
                                                          sin(angle) * lobe.second));
    // tangent d(tangent) d(angle) for a step of u and of the angle.
    float step = mix(1.0 / (ggx * (1.0 - u)), 1.0 / gaussian, spread) / (1.0 - u);
    float area = 2.0 * PI * tangent * step * length(cross(lobe.first, lobe.second)) / (n * n);
    float cosine = dot(result.half_vector, lobe.axis);
    result.weight = 1.0;
    result.solid_angle = area * cosine * cosine * cosine;
    return result;
}

half_vector_sample sample_of(half_vector_distribution lobe, uint j, uint k, float spread) {
    return lobe.kind == DISTRIBUTION_GGX ? ggx_sample(lobe.shape, j, k, spread)
                                         : gaussian_sample(lobe.shape, j, k);
}

// The mean radiance over the directions that a sample's half vectors reflect.
vec3 sample_radiance(surface_point surface, half_vector_sample point, vec3 incoming) {
    float jacobian = 4.0 * abs(dot(surface.outgoing, point.half_vector));
    return environment_mean(to_environment(surface, incoming), jacobian * point.solid_angle);
}

bool above_horizon(vec3 incoming) {
    return HORIZON == HORIZON_IGNORED || incoming.z > 0.0;
}

// ---------------------------------------------------------------------------------------------
// Half-vector lobes, of area one: the integral of rho(h) L(i) di = rho(h) L(i) 4 <o, h> dh

// The sum over the samples of the grid; zero if none of them reflects light.
vec3 sampled_half_vectors(surface_point surface, half_vector_distribution lobe, uint side) {
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint j = 0u; j < side; ++j) {
        for (uint k = 0u; k < side; ++k) {
            half_vector_sample point = sample_of(lobe, j, k, 0.0);
            float cosine = dot(surface.outgoing, point.half_vector);
            vec3 incoming = 2.0 * cosine * point.half_vector - surface.outgoing;
            float seen = above_horizon(incoming) ? 4.0 * max(cosine, 0.0) : 0.0;
            sum += point.weight * seen * sample_radiance(surface, point, incoming);
            weights += point.weight;
        }
    }
    return sum / max(weights, 1e-10);
}

// The mean of <o, h> over half vectors that face the viewer.
float mean_half_cosine(direction_lobe lobe, vec3 outgoing) {
    float a = dot(lobe.first, outgoing);
    float b = dot(lobe.second, outgoing);
    float spread = a * a + b * b;
    // A broad lobe's mean direction is shorter than one: R(kappa), 1 - 1/(2 kappa) - ... each way.
    float resultant = mean_resultant_length(1.0 / max(lobe_variance(lobe), 1e-8));
    // The variance of a height is at most that of all directions.
    return mean_above_zero(resultant * dot(lobe.axis, outgoing), sqrt(min(spread, 1.0 / 3.0)));
}

// The fraction of the light that is sampled, [0, 1]. Steep slopes reflect below the horizon, the
// others in all directions: if many are steep, no lobe about the mean slope's reflection can
// represent that, but samples can.
float share_of_wide_slopes(half_vector_distribution lobe) {
    if (lobe.kind != DISTRIBUTION_BECKMANN || ENVIRONMENT_METHOD != ENVIRONMENT_PREFILTERED)
        return 0.0;
    direction_lobe slopes = lobe.shape;
    return smoothstep(0.1, 0.4, dot(slopes.first, slopes.first) +
                                    dot(slopes.second, slopes.second));
}

vec3 reflect_half_vectors(surface_point surface, half_vector_distribution lobe) {
    if (sampled_by_grid())
        return sampled_half_vectors(surface, lobe, ENVIRONMENT_GRID);
    direction_lobe incoming = reflected_lobe(lobe.shape, surface.outgoing);
    float seen = 4.0 * mean_half_cosine(lobe.shape, surface.outgoing);
    if (HORIZON != HORIZON_IGNORED)
        seen *= lobe_share_above(incoming, SURFACE_NORMAL);
    if (HORIZON == HORIZON_CLIPPED)
        incoming = lobe_above(incoming, SURFACE_NORMAL);
    vec3 light = seen * lobe_radiance(surface, lobe, incoming);
    float wide = share_of_wide_slopes(lobe);
    uint side = wide > 0.0 ? ENVIRONMENT_GRID : 0u;
    return mix(light, sampled_half_vectors(surface, lobe, side), wide);
}

#endif
