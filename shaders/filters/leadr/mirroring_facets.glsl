#ifndef MIRRORING_FACETS_GLSL
#define MIRRORING_FACETS_GLSL

#extension GL_EXT_control_flow_attributes : require

// Texels of Gaussian slopes P, each with its base lobe about its own normal n: the integral
//   int P(s) sqrt(1 + s^2) D(<n, h>) G(<n, i>, <n, o>) ds,
// which is, times what both directions see of the texels, over 4 <omega_o, (-mean, 1)>, what they
// mirror. Developed here: the paper adds both variances, as if all base lobes were about the mean
// normal. Rough texels that vary by 0.5 each way then mirror 0.6 of the light from where they are
// seen, and 1.2 to 2 times as much light at 70 degrees.
//
// D is a sum of Gaussians of slopes over the plane of the half vector: of GGX, whose slopes have
// Student's t distribution of two degrees of freedom at the scale of Beckmann's, four. To first
// order each is a Gaussian of the texels' slopes, too, and so is its product with P, of which nodes
// are the Gauss-Hermite ones. The rest of the integrand is nearly constant: error 1.6 % for GGX, on
// average over deviations of slopes to 0.5, widths from 0.04 to 0.64 and views to 80 degrees.

#include "lib/lobe/plane_lobe.glsl"
#include "lib/microfacet/slope_masking.glsl"
#include "lib/microfacet/tilted_slopes.glsl"

const bool BASE_HAS_TAILS =
    MODEL == MODEL_MICROFACET && DISTRIBUTION == DISTRIBUTION_GGX && !BASE_AS_LOBE;

// Nodes along each axis. One Gaussian needs more of them than four of different widths.
const int MIRROR_NODES = BASE_HAS_TAILS ? 2 : 3;

// Place and weight of one of the nodes of an axis.
vec2 mirror_node(int i) {
    if (MIRROR_NODES == 2)
        return vec2(float(2 * i - 1), 0.5);
    return i == 1 ? vec2(0.0, 0.66666667) : vec2(1.7320508 * float(i - 1), 0.16666667);
}

// Texels, and the half vector.
struct lobes_of_texels {
    vec2 mean;
    vec3 covariance;
    float base_variance, parameter; // of base lobes
    float undrawn; // which part of a slope's distance from the mean decides how large facets are
    vec3 halfway, outgoing, incoming;
};

// Of a facet, over D.
float mirroring_facet(lobes_of_texels texels, vec2 slope) {
    float area = sqrt(1.0 + dot(slope, slope));
    float out_height = height_above_slope(slope, texels.outgoing);
    float seen = masking_shadowing(DISTRIBUTION, height_above_slope(slope, texels.incoming) / area,
                                   out_height / area, texels.parameter);
    if (DISPLACED)
        seen *= max(height_above_slope(mix(texels.mean, slope, texels.undrawn), texels.outgoing),
                    0.0) / max(out_height, COSINE_MINIMUM);
    return area * seen;
}

// Of one Gaussian, of variance `base` over the plane of the half vector.
float mirroring_gaussian(lobes_of_texels texels, vec2 half_slope, float base) {
    vec3 flat_base = flat_covariance_of_tilted(half_slope, base);
    mat2 c = mat2(texels.covariance.x, texels.covariance.z, texels.covariance.z,
                  texels.covariance.y);
    slope_distribution both =
        slope_distribution_of(texels.mean, texels.covariance + flat_base);
    mat2 gain = c * inverse(c + mat2(flat_base.x, flat_base.z, flat_base.z, flat_base.y));
    mat2 rest = c - gain * c;
    slope_distribution reflecting = slope_distribution_of(
        texels.mean + gain * (half_slope - texels.mean), vec3(rest[0][0], rest[1][1], rest[0][1]));
    vec3 to_half_plane = tilted_from_flat_slopes(half_slope);
    float square = 1.0 + dot(half_slope, half_slope), sum = 0.0;
    [[unroll]] for (int i = 0; i < MIRROR_NODES * MIRROR_NODES; ++i) {
        vec2 x = mirror_node(i / MIRROR_NODES), y = mirror_node(i % MIRROR_NODES);
        vec2 slope = slope_at(reflecting, vec2(x.x, y.x)), step = slope - half_slope;
        float facing = 1.0 + dot(slope, half_slope);
        vec2 place = vec2(to_half_plane.x * step.x + to_half_plane.z * step.y,
                          to_half_plane.z * step.x + to_half_plane.y * step.y);
        // Of the tangent of the angle between normal and half vector: to first order, and in fact.
        float linear = dot(place, place), scale = square / max(facing, 1e-3);
        float tangent = scale * scale * linear, inverse_fourth = (1.0 + tangent) * (1.0 + tangent);
        sum += x.y * y.y * inverse_fourth *
               exp(min(0.5 * (linear - tangent) / base, 60.0)) *
               mirroring_facet(texels, slope);
    }
    return square * sqrt(square) * slope_density(both, half_slope) * sum;
}

float mirroring_facets(lobes_of_texels texels) {
    vec2 half_slope = slope_of_normal(texels.halfway);
    if (!BASE_HAS_TAILS)
        return mirroring_gaussian(texels, half_slope, texels.base_variance);
    vec4 part = tail_weight(0.0), spread = tail_spread(0.0);
    float sum = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i)
        sum += part[i] * mirroring_gaussian(texels, half_slope, spread[i] * texels.base_variance);
    return sum;
}

#endif
