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
// Over the plane of the half vector, D is a sum of Gaussians of slopes: of GGX, whose slopes have
// Student's t distribution of two degrees of freedom at the scale of Beckmann's, four. To first
// order each is a Gaussian of the texels' slopes, too, and so is its product with P. The sum of
// these products is taken for one Gaussian of its mean and covariance. Far from the texels GGX's
// tail takes the place of the broadest Gaussian: it is nearly the same for all of them. The rest of
// the integrand, area, masking and the quotient of D and what it is to first order, varies little:
// a few nodes are enough. Error 0.8 % for GGX and 0.3 % for Beckmann, on average over deviations of
// slopes from 0.03 to 0.5, widths from 0.04 to 0.64 and directions from which they are seen, and
// 1.1 % where viewer or light is lower than 25 degrees. On rough slopes of 0.15 to 0.5 seen at 75
// to 83 degrees it is 3.3 %. Four nodes in each of the four Gaussians had 0.8 %, 1.6 % and 14 %:
// single Gaussians differ from what they are to first order by more than their sum.

#include "filters/leadr/base_lobes.glsl"
#include "lib/lobe/plane_lobe.glsl"
#include "lib/microfacet/slope_masking.glsl"
#include "lib/microfacet/tilted_slopes.glsl"

// A rule for Gaussians, exact for polynomials of the third degree: the mean and five nodes around
// it, whatever their turn. Weight of the mean: found for grazing views, in which masking has kinks.
const int MIRROR_NODES = 6;
const float MIRROR_WEIGHT_OF_MEAN = 0.3;

// Place of a node, in deviations, and its weight.
vec3 mirror_node(int i) {
    if (i == 0)
        return vec3(0.0, 0.0, MIRROR_WEIGHT_OF_MEAN);
    float angle = 0.3 + 2.0 * PI * float(i) / float(MIRROR_NODES - 1);
    float rest = 1.0 - MIRROR_WEIGHT_OF_MEAN;
    return vec3(sqrt(2.0 / rest) * vec2(cos(angle), sin(angle)), rest / float(MIRROR_NODES - 1));
}

// Texels, and the half vector.
struct lobes_of_texels {
    vec2 mean;
    vec3 covariance;
    base_lobes microfacets;
    float parameter; // of the microfacets that mask each other
    float undrawn; // which part of a slope's distance from the mean decides how large facets are
    vec3 halfway, outgoing, incoming;
};

// Texels that mirror.
struct mirroring_slopes {
    vec2 half_slope;
    slope_distribution tilted; // over the plane of the half vector
    vec3 flat_from_tilted;     // to first order
    float base_variance;
    float density; // of half vectors, per unit of slopes over their own plane
};

// 2 pi times the density of base lobes about texels at a distant slope.
float base_tail(base_lobes microfacets, vec2 mean, vec3 covariance) {
    float mean_variance = microfacets.variance * exp(microfacets.varies);
    return BASE_HAS_TAILS ? 2.0 * PI * density_of_tail(2.0 * mean_variance, mean, covariance) : 0.0;
}

mirroring_slopes mirroring_slopes_of(lobes_of_texels texels) {
    mirroring_slopes result;
    result.half_slope = slope_of_normal(texels.halfway);
    result.flat_from_tilted = flat_from_tilted_slopes(result.half_slope);
    result.base_variance = texels.microfacets.variance;
    vec3 to_tilted = tilted_from_flat_slopes(result.half_slope);
    vec3 c = transformed_covariance(to_tilted, texels.covariance);
    vec2 mean = transformed_slope(to_tilted, texels.mean - result.half_slope);
    vec4 base = vec4(texels.microfacets.variance), part = vec4(1.0, 0.0, 0.0, 0.0);
    if (BASE_HAS_TAILS) {
        // Of the median.
        base *= exp(-texels.microfacets.varies) * tail_spread(texels.microfacets.varies);
        part = tail_weight(texels.microfacets.varies);
    }
    // Of the sum of both covariances C + B, and of (C + B)^-1 times the mean.
    float own_determinant = max(c.x * c.y - c.z * c.z, 0.0);
    vec4 inverse_determinant = 1.0 / (own_determinant + base * (c.x + c.y + base));
    vec4 x = ((c.y + base) * mean.x - c.z * mean.y) * inverse_determinant;
    vec4 y = ((c.x + base) * mean.y - c.z * mean.x) * inverse_determinant;
    vec4 exponent = 0.5 * (x * mean.x + y * mean.y);
    part *= exp(-exponent) * sqrt(inverse_determinant);
    float sum = dot(part, vec4(1.0));
    float tail = exponent.w > TAIL_BEGINS ? max(base_tail(texels.microfacets, mean, c) - sum, 0.0)
                                          : 0.0;
    float all = max(sum + tail, 1e-30);
    result.density = 0.5 * INVERSE_PI * all;
    part /= all;
    tail /= all;
    // Means B (C + B)^-1 mean, and covariances B (C + B)^-1 C.
    x *= base;
    y *= base;
    vec2 place = vec2(dot(part, x), dot(part, y)) + tail * mean;
    x -= place.x;
    y -= place.y;
    vec2 rest = mean - place;
    vec4 scale = base * inverse_determinant;
    float both = own_determinant * dot(part, scale);
    vec3 covariance = both * vec3(1.0, 1.0, 0.0) + (dot(part, scale * base) + tail) * c;
    covariance += vec3(dot(part, x * x), dot(part, y * y), dot(part, x * y));
    covariance += tail * vec3(rest * rest, rest.x * rest.y);
    result.tilted = slope_distribution_of(place, covariance);
    return result;
}

// The slope of a node, and D there over what it is to first order.
vec2 mirroring_slope(mirroring_slopes mirroring, vec2 standardised, out float quotient) {
    vec2 tilted = slope_at(mirroring.tilted, standardised);
    vec2 slope = mirroring.half_slope + transformed_slope(mirroring.flat_from_tilted, tilted);
    float square = 1.0 + dot(mirroring.half_slope, mirroring.half_slope);
    float facing = 1.0 + dot(slope, mirroring.half_slope);
    // Of the tangent of the angle between normal and half vector: to first order, and in fact.
    float linear = dot(tilted, tilted), scale = square / max(facing, 1e-3);
    float tangent = scale * scale * linear, spread = 2.0 * mirroring.base_variance;
    float root = BASE_HAS_TAILS ? (spread + linear) / (spread + tangent)
                                : exp(min(0.5 * (linear - tangent) / spread, 30.0));
    root *= 1.0 + tangent;
    quotient = facing > 0.0 ? root * root : 0.0;
    return slope;
}

// Of a facet, over D.
float mirroring_facet(lobes_of_texels texels, vec2 slope) {
    float inverse_area = inversesqrt(1.0 + dot(slope, slope));
    float out_height = height_above_slope(slope, texels.outgoing);
    float seen = masking_shadowing(DISTRIBUTION,
                                   height_above_slope(slope, texels.incoming) * inverse_area,
                                   out_height * inverse_area, texels.parameter);
    if (DISPLACED)
        seen *= max(height_above_slope(mix(texels.mean, slope, texels.undrawn), texels.outgoing),
                    0.0) / max(out_height, COSINE_MINIMUM);
    return seen / inverse_area;
}

float mirroring_facets(lobes_of_texels texels) {
    mirroring_slopes mirroring = mirroring_slopes_of(texels);
    float sum = 0.0;
    [[unroll]] for (int i = 0; i < MIRROR_NODES; ++i) {
        vec3 node = mirror_node(i);
        float quotient;
        vec2 slope = mirroring_slope(mirroring, node.xy, quotient);
        sum += node.z * quotient * mirroring_facet(texels, slope);
    }
    return mirroring.density * sum;
}

#endif
