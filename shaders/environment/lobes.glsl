#ifndef ENVIRONMENT_LOBES_GLSL
#define ENVIRONMENT_LOBES_GLSL

// What a lobe of half vectors reflects of the environment.

#include "shading/base_material.glsl"
#include "environment/environment.glsl"
#include "interface/irradiance_harmonics.h"
#include "lib/light/spherical_harmonics.glsl"

layout(set = 0, binding = 29, std430) readonly buffer irradiance_block {
    irradiance_harmonics irradiance;
};

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
// and 36, tan theta = alpha sqrt(u/(1 - u)), and a deviation is alpha/sqrt(2).
half_vector_sample ggx_sample(direction_lobe lobe, uint j, uint k) {
    float n = float(ENVIRONMENT_GRID);
    float u = (float(j) + 0.5) / n;
    float angle = 2.0 * PI * (float(k) + 0.5 * float(j & 1u)) / n;
    float tangent = sqrt(2.0 * u / (1.0 - u));
    half_vector_sample result;
    result.half_vector = normalize(lobe.axis + tangent * (cos(angle) * lobe.first +
                                                          sin(angle) * lobe.second));
    // Per unit of the plane the density is 1/(pi a^2) (1 - u)^2, a^2 = 2 first x second.
    float area = 2.0 * PI * length(cross(lobe.first, lobe.second)) / (n * n * (1.0 - u) * (1.0 - u));
    float cosine = dot(result.half_vector, lobe.axis);
    result.weight = 1.0;
    result.solid_angle = area * cosine * cosine * cosine;
    return result;
}

half_vector_sample sample_of(half_vector_distribution lobe, uint j, uint k) {
    return lobe.kind == DISTRIBUTION_GGX ? ggx_sample(lobe.shape, j, k)
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
            half_vector_sample point = sample_of(lobe, j, k);
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

// ---------------------------------------------------------------------------------------------
// Microfacets, about a normal of their own

// A lobe is broader than base lobes of this parameter because the normals vary. If both are
// Gaussian, the mean normal of the facets that reflect about a half vector lies between the axis
// and the half vector. [0, 1]: how far.
float spread_of_normals(direction_lobe lobe, float parameter) {
    float base = 1.0 / base_lobe_concentration(DISTRIBUTION, parameter);
    return 1.0 - min(base / max(lobe_variance(lobe), 1e-10), 1.0);
}

vec3 sampled_microfacets(surface_point surface, half_vector_distribution lobe, vec3 f0,
                         float parameter) {
    float spread = spread_of_normals(lobe.shape, parameter);
    float mean_cosine = dot(lobe.shape.axis, surface.outgoing);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint j = 0u; j < ENVIRONMENT_GRID; ++j) {
        for (uint k = 0u; k < ENVIRONMENT_GRID; ++k) {
            half_vector_sample point = sample_of(lobe, j, k);
            float half_cosine = dot(surface.outgoing, point.half_vector);
            vec3 incoming = 2.0 * half_cosine * point.half_vector - surface.outgoing;
            vec3 normal = normalize(mix(lobe.shape.axis, point.half_vector, spread));
            float outgoing_cosine = max(dot(normal, surface.outgoing), 1e-3);
            float visible = masking_shadowing(DISTRIBUTION, dot(normal, incoming), outgoing_cosine,
                                              parameter);
            float scale = max(half_cosine, 0.0) /
                          (outgoing_cosine * max(dot(normal, point.half_vector), 1e-3));
            float seen = above_horizon(incoming) ? visible * scale : 0.0;
            vec3 fresnel = fresnel_schlick(f0, vec3(1.0), half_cosine);
            sum += point.weight * seen * fresnel * sample_radiance(surface, point, incoming);
            weights += point.weight;
        }
    }
    return sum * (scattering_scale(f0, mean_cosine, parameter) / weights);
}

// Karis, 2013, Real Shading in Unreal Engine 4: the product of two integrals, the reflection of a
// white environment and the mean of the environment over the lobe.
//
// `parameter` is that of the base lobes and determines masking. The albedo for a white environment
// accounts for the base lobes' own horizon, but not for the surface's.
vec3 reflect_microfacets(surface_point surface, half_vector_distribution lobe, vec3 f0,
                         float parameter) {
    if (sampled_by_grid())
        return sampled_microfacets(surface, lobe, f0, parameter);
    vec3 normal = lobe.shape.axis;
    float outgoing_cosine = dot(normal, surface.outgoing);
    vec3 reflected = specular_albedo(albedo_of(outgoing_cosine, parameter), f0, vec3(1.0)) *
                     scattering_scale(f0, outgoing_cosine, parameter);
    direction_lobe incoming = reflected_lobe(lobe.shape, surface.outgoing);
    if (HORIZON != HORIZON_IGNORED) {
        float own = max(lobe_share_above(incoming, normal), 0.05);
        reflected *= min(lobe_share_above(incoming, SURFACE_NORMAL) / own, 1.0);
    }
    if (HORIZON == HORIZON_CLIPPED)
        incoming = lobe_above(lobe_above(incoming, normal), SURFACE_NORMAL);
    return reflected * lobe_radiance(surface, lobe, incoming);
}

// ---------------------------------------------------------------------------------------------
// Lambert's part

// Irradiance over pi, for a mean normal of at most unit length.
vec3 mean_irradiance(surface_point surface, vec3 mean_normal) {
    vec3 normal = to_environment(surface, mean_normal);
    if (ENVIRONMENT_METHOD == ENVIRONMENT_MIP)
        return environment.intensity * length(mean_normal) *
               textureLod(environment_cube, normal, 16.0).rgb;
    return (environment.intensity * INVERSE_PI) *
           harmonic_irradiance_of_mean_normal(irradiance.coefficients, normal);
}

// The albedo of what microfacets let through: 1 - F = (1 - F0) (1 - (1 - c)^5).
vec3 let_through(surface_point surface, base_material base) {
    if (MODEL != MODEL_MICROFACET)
        return base.diffuse;
    vec4 albedo = albedo_of(dot(base.normal, surface.outgoing), base.width);
    return diffuse_albedo(albedo, base.diffuse, base.specular, vec3(1.0));
}

vec3 reflect_lambert(surface_point surface, base_material base, vec3 mean_normal) {
    return let_through(surface, base) * mean_irradiance(surface, mean_normal);
}

// ---------------------------------------------------------------------------------------------
// A base material

vec3 reflect_base_specular(surface_point surface, base_material base) {
    if (MODEL == MODEL_MICROFACET) {
        float width = widened_width(base);
        return reflect_microfacets(surface, base_half_vectors(base.normal, width, surface.outgoing),
                                   base.specular, width);
    }
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i) {
        vec3 axis = rotate_from_pole(base.normal, material.lobe_direction[i].xyz);
        float parameter = widened_lobe_parameter(i, base);
        sum += material.lobe_colour[i].rgb *
               reflect_half_vectors(surface, base_half_vectors(axis, parameter, surface.outgoing));
    }
    return base.specular * sum;
}

vec3 reflect_base_material(surface_point surface, base_material base, vec3 mean_normal) {
    vec3 sum = reflect_base_specular(surface, base);
    if (DIFFUSE)
        sum += reflect_lambert(surface, base, mean_normal);
    return sum;
}

#endif
