#version 460
#extension GL_GOOGLE_include_directive : require

// The table of interface/environment/broad_reflection.h: what microfacets of each roughness reflect
// towards a viewer at each angle, as the lobe that filtered environments are read with and a
// polynomial times the cosine of incidence, which is exact at the horizon. Both together are
// nearest to the reflectance times cosine in least squares over spherical harmonics up to degree 8,
// whose weights fall with the degree as those of environments do; the total is kept exactly. No
// environment went into it.

#include "interface/environment/broad_reflection.h"
#include "interface/environment/environment_light.h"
#include "environment/lobe_row.glsl"
#include "environment/reflected_rings.glsl"
#include "lib/microfacet/reflection_lobe.glsl"

layout(constant_id = SPECIALISE_ENVIRONMENT_PROBES) const uint ENVIRONMENT_PROBES = 2;

// One workgroup per texel; one invocation per ring, and then per harmonic.
layout(local_size_x = RINGS) in;

layout(set = 0, binding = 0) uniform writeonly image2DArray broad_reflection;
layout(set = 0, binding = 1, std430) readonly buffer harmonics_block { broad_harmonics known; };

// What is fitted: what F_0 and F_90 reflect, for an albedo of 1, and the lobe.
const int LOBE = 2, FITTED = 3;

shared vec2 ring_sums[RINGS][BROAD_HARMONICS]; // of what F_0 and F_90 reflect
shared vec2 albedo;
shared float harmonics[FITTED][BROAD_HARMONICS];
shared float coefficients[FITTED][BROAD_FUNCTIONS];
shared float left[FITTED][BROAD_HARMONICS]; // what the functions leave

// By order: its first harmonic, and its first function.
const int FIRST_HARMONIC[] = int[](0, 9, 17, 24, BROAD_HARMONICS);
const int FIRST_FUNCTION[] = int[](0, 4, 7, 9, BROAD_FUNCTIONS);

int order_of_harmonic(int k) {
    return int(k >= FIRST_HARMONIC[1]) + int(k >= FIRST_HARMONIC[2]) + int(k >= FIRST_HARMONIC[3]);
}

int order_of_function(int j) {
    return int(j >= FIRST_FUNCTION[1]) + int(j >= FIRST_FUNCTION[2]) + int(j >= FIRST_FUNCTION[3]);
}

// cos(m azimuth) times sin^m of a direction, of its height and its x.
float azimuthal_part(int order, float height, float aside) {
    float square = (1.0 - height) * (1.0 + height);
    return order == 0   ? 1.0
           : order == 1 ? aside
           : order == 2 ? 2.0 * aside * aside - square
                        : aside * (4.0 * aside * aside - 3.0 * square);
}

// Legendre's functions of one order over their first one, by the usual recurrence: that of degree
// l + 1 from those of degrees l and l - 1.
float next_degree(int l, int order, float height, float current, float before) {
    return (height * float(2 * l + 1) * current - float(l + order) * before) *
           (1.0 / float(l + 1 - order));
}

// The harmonic cos(m azimuth) Y_lm of a direction, without its scale.
float harmonic_of(int degree, int order, float height, float aside) {
    float before = 0.0, current = 1.0;
    for (int l = order; l < degree; ++l) {
        float next = next_degree(l, order, height, current, before);
        before = current;
        current = next;
    }
    return azimuthal_part(order, height, aside) * current;
}

// Adds all harmonics of one direction, times what it reflects.
void add_harmonics(reflected_light light, inout vec2 sums[BROAD_HARMONICS]) {
    for (int order = 0; order < BROAD_ORDERS; ++order) {
        vec2 parts = azimuthal_part(order, light.height, light.aside) * light.parts;
        float before = 0.0, current = 1.0;
        for (int l = order; l <= BROAD_DEGREE; ++l) {
            sums[FIRST_HARMONIC[order] + l - order] += current * parts;
            float next = next_degree(l, order, light.height, current, before);
            before = current;
            current = next;
        }
    }
}

// What a von Mises-Fisher lobe leaves of a degree: A_l = I_(l+1/2)(kappa)/I_(1/2)(kappa), by
// Miller's backward recurrence A_(l-1) = A_(l+1) + (2 l + 1) A_l/kappa. Mardia, Jupp, 2000,
// Directional Statistics, section 9.3.
float factor_of_lobe(int degree, float concentration) {
    float above = 0.0, current = 1e-20, factor = current;
    for (int l = 40; l > 0; --l) {
        float below = above + float(2 * l + 1) / concentration * current;
        above = current;
        current = below;
        if (l - 1 >= degree)
            factor = current;
        if (current > 1e10) { // only quotients count
            above *= 1e-10;
            current *= 1e-10;
            factor *= 1e-10;
        }
    }
    return factor / current;
}

// The same of a lobe proportional to GGX's D(theta/2) with alpha^2 = 1/(2 kappa), (1 + b x)^-2 of
// x = 1 - cos theta with b = kappa - 1/2: by the midpoint rule on log(1 + b x).
float factor_of_ggx_lobe(int degree, float concentration) {
    const int POINTS = 64;
    float b = max(concentration - 0.5, 1e-3), whole = log(1.0 + 2.0 * b);
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < POINTS; ++i) {
        float inverse = exp(-whole * (float(i) + 0.5) / float(POINTS)); // 1/(1 + b x)
        sum += inverse * harmonic_of(degree, 0, 1.0 - (1.0 / inverse - 1.0) / b, 0.0);
        weights += inverse;
    }
    return sum / weights;
}

// How much of a round lobe is read from the cube of GGX lobes: share_of_tails() of
// environment/environment.glsl.
float share_of_ggx(float concentration) {
    return DISTRIBUTION == DISTRIBUTION_GGX
               ? 1.0 - smoothstep(0.1, 0.17, inversesqrt(2.0 * concentration))
               : 0.0;
}

// Of the row of lobes that filtered environments are read with, of area one.
float harmonic_of_lobe(int degree, int order, reflection_lobe lobe) {
    float along = lobe.along * lobe.along, across = lobe.across * lobe.across;
    lobe_row row = row_of_lobe(max(along, across), min(along, across), float(ENVIRONMENT_PROBES));
    vec3 axis = vec3(-sin(lobe.angle), 0.0, cos(lobe.angle));
    vec3 longer = along >= across ? lobe.along * vec3(-axis.z, 0.0, axis.x)
                                  : vec3(0.0, lobe.across, 0.0);
    float sum = 0.0, weights = 0.0;
    for (uint i = 0u; i < uint(row.count); ++i) {
        vec2 place = place_in_row(row, i);
        vec3 direction = normalize(axis + place.x * row.reach * longer);
        sum += place.y * harmonic_of(degree, order, direction.z, direction.x);
        weights += place.y;
    }
    float concentration = 1.0 / max(row.variance, 1e-6);
    return mix(factor_of_lobe(degree, concentration), factor_of_ggx_lobe(degree, concentration),
               share_of_ggx(concentration)) *
           sum / weights;
}

// The lobe that completes the polynomials.
reflection_lobe lobe_beside_polynomial(float cosine, float roughness) {
    const float tails = float(DISTRIBUTION == DISTRIBUTION_GGX);
    reflection_lobe lobe = lobe_of_reflection(tails, cosine, roughness);
    lobe = mixed_lobe(lobe, lobe_of_grazing_reflection(cosine, roughness),
                      albedo.y / max(albedo.x * (1.0 - lobe.diffuse_share) + albedo.y, 1e-10));
    return completed_lobe(lobe, cosine, 1.0);
}

// The coefficients of the functions that are nearest to the harmonics in least squares, by
// invocation.
void fit_function(int own) {
    int which = own / BROAD_FUNCTIONS, j = own % BROAD_FUNCTIONS, order = order_of_function(j);
    int first = FIRST_HARMONIC[order], count = FIRST_HARMONIC[order + 1] - first;
    float sum = 0.0;
    for (int k = 0; k < count; ++k)
        sum += known.coefficient[12 * j + k] * harmonics[which][first + k];
    coefficients[which][j] = sum;
}

void subtract_functions(int k) {
    int order = order_of_harmonic(k), row = k - FIRST_HARMONIC[order];
    for (int which = 0; which < FITTED; ++which) {
        float sum = 0.0;
        for (int j = FIRST_FUNCTION[order]; j < FIRST_FUNCTION[order + 1]; ++j)
            sum += coefficients[which][j] * known.harmonic[12 * j + row];
        left[which][k] = harmonics[which][k] - sum;
    }
}

// The lobe's weight beside the functions.
float weight_of_lobe(int part) {
    float both = 0.0, square = 0.0, whole = 0.0;
    for (int k = 0; k < BROAD_HARMONICS; ++k) {
        both += left[part][k] * left[LOBE][k];
        square += left[LOBE][k] * left[LOBE][k];
        whole += harmonics[LOBE][k] * harmonics[LOBE][k];
    }
    return clamp(both / (square + 1e-4 * whole), 0.0, 1.5);
}

float coefficient_beside_lobe(int part, float weight, int j) {
    return coefficients[part][j] - weight * coefficients[LOBE][j];
}

vec4 coefficients_beside_lobe(int part, float weight, int j) {
    return vec4(coefficient_beside_lobe(part, weight, j),
                coefficient_beside_lobe(part, weight, j + 1),
                coefficient_beside_lobe(part, weight, j + 2),
                coefficient_beside_lobe(part, weight, j + 3));
}

// `part`: 0 for F_0, 1 for F_90.
void store_part(int part, ivec2 texel) {
    float weight = weight_of_lobe(part);
    vec4 upright = coefficients_beside_lobe(part, weight, 0);
    // The integrals of the functions that do not vanish: of z^(n + 1) over the hemisphere.
    float total = 2.0 * PI * dot(upright, 1.0 / vec4(2.0, 3.0, 4.0, 5.0));
    upright.x += (1.0 - weight - total) * INVERSE_PI;
    imageStore(broad_reflection, ivec3(texel, 3 * part), upright);
    imageStore(broad_reflection, ivec3(texel, 3 * part + 1),
               coefficients_beside_lobe(part, weight, 4));
    imageStore(broad_reflection, ivec3(texel, 3 * part + 2),
               vec4(coefficient_beside_lobe(part, weight, 8),
                    coefficient_beside_lobe(part, weight, 9), weight, 0.0));
}

void main() {
    ivec2 texel = ivec2(gl_WorkGroupID.xy);
    vec2 place = vec2(texel) / float(BROAD_REFLECTION_SIZE - 1);
    float cosine = max(place.x * place.x, 1e-3);
    float sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    float roughness = mix(BROAD_LEAST_ROUGHNESS, 1.0, place.y);
    int own = int(gl_LocalInvocationID.x);
    vec3 ring = ring_of_half_vectors(own, cosine, sine, alpha_from_roughness(roughness));
    vec2 sums[BROAD_HARMONICS];
    for (int k = 0; k < BROAD_HARMONICS; ++k)
        sums[k] = vec2(0.0);
    for (int i = 0; i < AZIMUTHS; ++i)
        add_harmonics(light_of_ring(ring, i, cosine, sine,
                                    microfacet_parameter(DISTRIBUTION, roughness),
                                    microfacet_parameter(MASKING, roughness)),
                      sums);
    for (int k = 0; k < BROAD_HARMONICS; ++k)
        ring_sums[own][k] = sums[k];
    barrier();
    int harmonic = min(own, BROAD_HARMONICS - 1), order = order_of_harmonic(harmonic);
    int degree = order + harmonic - FIRST_HARMONIC[order];
    float scale = known.scale[harmonic];
    vec2 reflected = vec2(0.0);
    for (int i = 0; i < RINGS; ++i)
        reflected += ring_sums[i][harmonic];
    if (own == 0)
        albedo = reflected;
    barrier();
    if (own < BROAD_HARMONICS) {
        harmonics[0][own] = scale * reflected.x / max(albedo.x, 1e-10);
        harmonics[1][own] = scale * reflected.y / max(albedo.y, 1e-10);
        harmonics[LOBE][own] =
            scale * harmonic_of_lobe(degree, order, lobe_beside_polynomial(cosine, roughness));
    }
    barrier();
    if (own < FITTED * BROAD_FUNCTIONS)
        fit_function(own);
    barrier();
    if (own < BROAD_HARMONICS)
        subtract_functions(own);
    barrier();
    if (own < 2)
        store_part(own, texel);
}
