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

// One workgroup per texel, one invocation per ring.
layout(local_size_x = RINGS) in;

layout(set = 0, binding = 0) uniform writeonly image2DArray broad_reflection;
layout(set = 0, binding = 1, std430) readonly buffer harmonics_block { broad_harmonics known; };

shared vec2 ring_sums[BROAD_HARMONICS][RINGS];
shared vec2 reflected[BROAD_HARMONICS]; // the harmonics of what F_0 and F_90 reflect

// The harmonics cos(m azimuth) Y_lm of a direction: its height and its x.
void harmonics_of(float height, float aside, out float values[BROAD_HARMONICS]) {
    float square = (1.0 - height) * (1.0 + height);
    vec4 azimuthal = vec4(1.0, aside, 2.0 * aside * aside - square,
                          aside * (4.0 * aside * aside - 3.0 * square));
    int k = 0;
    for (int m = 0; m < BROAD_ORDERS; ++m) {
        // Legendre's functions of order m over their first one, by the usual recurrence.
        float before = 0.0, current = 1.0;
        for (int l = m; l <= BROAD_DEGREE; ++l, ++k) {
            values[k] = known.scale[k] * azimuthal[m] * current;
            float next = (height * float(2 * l + 1) * current - float(l + m) * before) /
                         float(l + 1 - m);
            before = current;
            current = next;
        }
    }
}

// What a von Mises-Fisher lobe leaves of each degree: A_l = I_(l+1/2)(kappa)/I_(1/2)(kappa), by
// Miller's backward recurrence A_(l-1) = A_(l+1) + (2 l + 1) A_l/kappa. Mardia, Jupp, 2000,
// Directional Statistics, section 9.3.
void factors_of_lobe(float concentration, out float factors[BROAD_DEGREE + 1]) {
    float above = 0.0, current = 1e-20;
    for (int l = 40; l > 0; --l) {
        if (l <= BROAD_DEGREE)
            factors[l] = current;
        float below = above + float(2 * l + 1) / concentration * current;
        above = current;
        current = below;
        if (current > 1e10) { // only quotients count
            above *= 1e-10;
            current *= 1e-10;
            for (int i = l; i <= BROAD_DEGREE; ++i)
                factors[i] *= 1e-10;
        }
    }
    factors[0] = current;
    for (int l = BROAD_DEGREE; l >= 0; --l)
        factors[l] /= current;
}

// The same of a lobe proportional to GGX's D(theta/2) with alpha^2 = 1/(2 kappa), (1 + b x)^-2 of
// x = 1 - cos theta with b = kappa - 1/2: by the midpoint rule on log(1 + b x).
void factors_of_ggx_lobe(float concentration, out float factors[BROAD_DEGREE + 1]) {
    const int POINTS = 64;
    float b = max(concentration - 0.5, 1e-3), whole = log(1.0 + 2.0 * b);
    for (int l = 0; l <= BROAD_DEGREE; ++l)
        factors[l] = 0.0;
    for (int i = 0; i < POINTS; ++i) {
        float inverse = exp(-whole * (float(i) + 0.5) / float(POINTS)); // 1/(1 + b x)
        float cosine = 1.0 - (1.0 / inverse - 1.0) / b;
        float before = 0.0, current = 1.0;
        for (int l = 0; l <= BROAD_DEGREE; ++l) {
            factors[l] += inverse * current;
            float next = (float(2 * l + 1) * cosine * current - float(l) * before) / float(l + 1);
            before = current;
            current = next;
        }
    }
    for (int l = BROAD_DEGREE; l >= 0; --l)
        factors[l] /= factors[0];
}

// How much of a round lobe is read from the cube of GGX lobes: share_of_tails() of
// environment/environment.glsl.
float share_of_ggx(float concentration) {
    return DISTRIBUTION == DISTRIBUTION_GGX
               ? 1.0 - smoothstep(0.1, 0.17, inversesqrt(2.0 * concentration))
               : 0.0;
}

// Of the row of lobes that filtered environments are read with, of area one.
void harmonics_of_lobe(reflection_lobe lobe, out float values[BROAD_HARMONICS]) {
    float along = lobe.along * lobe.along, across = lobe.across * lobe.across;
    lobe_row row = row_of_lobe(max(along, across), min(along, across), float(ENVIRONMENT_PROBES));
    float factors[BROAD_DEGREE + 1];
    float concentration = 1.0 / max(row.variance, 1e-6), tails = share_of_ggx(concentration);
    factors_of_lobe(concentration, factors);
    if (tails > 0.0) {
        float factors_of_tails[BROAD_DEGREE + 1];
        factors_of_ggx_lobe(concentration, factors_of_tails);
        for (int l = 0; l <= BROAD_DEGREE; ++l)
            factors[l] = mix(factors[l], factors_of_tails[l], tails);
    }
    for (int k = 0; k < BROAD_HARMONICS; ++k)
        values[k] = 0.0;
    float weights = 0.0;
    vec3 axis = vec3(-sin(lobe.angle), 0.0, cos(lobe.angle));
    vec3 longer = along >= across ? lobe.along * vec3(-axis.z, 0.0, axis.x)
                                  : vec3(0.0, lobe.across, 0.0);
    for (uint i = 0u; i < uint(row.count); ++i) {
        vec2 place = place_in_row(row, i);
        vec3 direction = normalize(axis + place.x * row.reach * longer);
        float own[BROAD_HARMONICS];
        harmonics_of(direction.z, direction.x, own);
        int k = 0;
        for (int m = 0; m < BROAD_ORDERS; ++m)
            for (int l = m; l <= BROAD_DEGREE; ++l, ++k)
                values[k] += place.y * factors[l] * own[k];
        weights += place.y;
    }
    for (int k = 0; k < BROAD_HARMONICS; ++k)
        values[k] /= weights;
}

// The coefficients of the functions that are nearest to harmonics in least squares, and what is
// left of these.
void fit_functions(inout float values[BROAD_HARMONICS],
                   out float coefficients[BROAD_FUNCTIONS]) {
    int first = 0, j = 0;
    for (int m = 0; m < BROAD_ORDERS; ++m) {
        int count = BROAD_DEGREE + 1 - m, functions = BROAD_ORDERS - m;
        for (int i = 0; i < functions; ++i) {
            float sum = 0.0;
            for (int k = 0; k < count; ++k)
                sum += known.coefficient[12 * (j + i) + k] * values[first + k];
            coefficients[j + i] = sum;
        }
        for (int i = 0; i < functions; ++i)
            for (int k = 0; k < count; ++k)
                values[first + k] -= coefficients[j + i] * known.harmonic[12 * (j + i) + k];
        first += count;
        j += functions;
    }
}

float product(float a[BROAD_HARMONICS], float b[BROAD_HARMONICS]) {
    float sum = 0.0;
    for (int k = 0; k < BROAD_HARMONICS; ++k)
        sum += a[k] * b[k];
    return sum;
}

// The integrals of the functions that do not vanish: of z^(n + 1) over the hemisphere.
float total_of(float coefficients[BROAD_FUNCTIONS]) {
    return 2.0 * PI * (coefficients[0] / 2.0 + coefficients[1] / 3.0 + coefficients[2] / 4.0 +
                       coefficients[3] / 5.0);
}

// `part`: 0 for F_0, 1 for F_90. `lobe_left`: what the functions leave of the lobe, with the
// coefficients `lobe_functions`.
void store_part(int part, ivec2 texel, float albedo, float lobe_left[BROAD_HARMONICS],
                float lobe_functions[BROAD_FUNCTIONS], float lobe_square) {
    float values[BROAD_HARMONICS], coefficients[BROAD_FUNCTIONS];
    for (int k = 0; k < BROAD_HARMONICS; ++k)
        values[k] = reflected[k][part] / max(albedo, 1e-10);
    fit_functions(values, coefficients);
    float weight =
        product(values, lobe_left) / (product(lobe_left, lobe_left) + 1e-4 * lobe_square);
    weight = clamp(weight, 0.0, 1.5);
    for (int j = 0; j < BROAD_FUNCTIONS; ++j)
        coefficients[j] -= weight * lobe_functions[j];
    coefficients[0] += (1.0 - weight - total_of(coefficients)) * INVERSE_PI;
    imageStore(broad_reflection, ivec3(texel, 3 * part),
               vec4(coefficients[0], coefficients[1], coefficients[2], coefficients[3]));
    imageStore(broad_reflection, ivec3(texel, 3 * part + 1),
               vec4(coefficients[4], coefficients[5], coefficients[6], coefficients[7]));
    imageStore(broad_reflection, ivec3(texel, 3 * part + 2),
               vec4(coefficients[8], coefficients[9], weight, 0.0));
}

void main() {
    ivec2 texel = ivec2(gl_WorkGroupID.xy);
    vec2 place = vec2(texel) / float(BROAD_REFLECTION_SIZE - 1);
    float cosine = max(place.x * place.x, 1e-3);
    float sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    float roughness = mix(BROAD_LEAST_ROUGHNESS, 1.0, place.y);
    int own = int(gl_LocalInvocationID.x);
    vec3 ring = ring_of_half_vectors(own, cosine, sine, alpha_from_roughness(roughness));
    for (int k = 0; k < BROAD_HARMONICS; ++k)
        ring_sums[k][own] = vec2(0.0);
    for (int i = 0; i < AZIMUTHS; ++i) {
        reflected_light light =
            light_of_ring(ring, i, cosine, sine, microfacet_parameter(DISTRIBUTION, roughness),
                          microfacet_parameter(MASKING, roughness));
        float values[BROAD_HARMONICS];
        harmonics_of(light.height, light.aside, values);
        for (int k = 0; k < BROAD_HARMONICS; ++k)
            ring_sums[k][own] += values[k] * light.parts;
    }
    barrier();
    if (own < BROAD_HARMONICS) {
        vec2 sum = vec2(0.0);
        for (int i = 0; i < RINGS; ++i)
            sum += ring_sums[own][i];
        reflected[own] = sum;
    }
    barrier();
    if (own > 0)
        return;
    vec2 albedo = reflected[0] / known.scale[0];
    reflection_lobe lobe = lobe_of_reflection(DISTRIBUTION == DISTRIBUTION_GGX, cosine, roughness);
    lobe = mixed_lobe(lobe, lobe_of_grazing_reflection(cosine, roughness),
                      albedo.y / max(albedo.x * (1.0 - lobe.diffuse_share) + albedo.y, 1e-10));
    lobe = completed_lobe(lobe, cosine, 1.0);
    float lobe_left[BROAD_HARMONICS], lobe_functions[BROAD_FUNCTIONS];
    harmonics_of_lobe(lobe, lobe_left);
    float lobe_square = product(lobe_left, lobe_left);
    fit_functions(lobe_left, lobe_functions);
    store_part(0, texel, albedo.x, lobe_left, lobe_functions, lobe_square);
    store_part(1, texel, albedo.y, lobe_left, lobe_functions, lobe_square);
}
