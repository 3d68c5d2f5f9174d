#ifndef BINS_GLSL
#define BINS_GLSL

// Bins of a map of lobe moments (interface/moment_bins.h) as a pixel sees them, and their sum for a
// light.

#include "shading/filtered_maps.glsl"
#include "interface/moment_bins.h"
#include "lib/lobe/lambert_plane.glsl"
#include "lib/lobe/plane_gaussian.glsl"
#include "lib/lobe/plane_lobe.glsl"

layout(constant_id = SPECIALISE_BIN_COLOUR) const bool BIN_COLOUR = false;
layout(constant_id = SPECIALISE_BIN_WIDTHS) const bool BIN_WIDTHS = true;

layout(set = 0, binding = 16) uniform sampler2DArray moment_map;
layout(set = 0, binding = 22, std140) uniform binning_block { moment_binning_constants binning; };

// Sums over the bins for one light.
struct light_sum {
    float distribution;
    vec3 normal;     // of the texels that reflect, weighted by their part of the distribution
    float sharpness; // of their base lobes, weighted in the same way
    vec3 colour;
};

const int MAXIMUM_TERMS = 4;

// A bin under the pixel.
struct plane_bin {
    float mass;
    float sharpness;     // mean of 1 / deviation of the base lobes
    float variance;      // of the base lobes: the median
    float mean_variance; // and the mean
    vec2 mean;           // of their places
    float spread;        // half the trace of their covariance
    vec3 covariance;     // (xx, yy, xy) of the lobe in the plane, base lobes included
    vec3 axis;           // the same as a direction
    mat2 gain;           // change of the reflecting lobes' mean place with that of the half vector
    plane_gaussian terms[MAXIMUM_TERMS]; // the first term_count()
    float own;           // [0, 1]: how much of the bin has the base lobe's exact shape
    vec2 own_parameter;  // of base lobes as broad as the bin: of the sharper and the broader half
    vec2 own_share;
    vec3 colour;
};

uint distribution_kind() {
    return BASE_AS_LOBE ? DISTRIBUTION_VMF : DISTRIBUTION;
}

vec4 fetch_moments(map_area area, uint layer) {
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < probes_of(area); ++i)
        sum += textureLod(moment_map, vec3(probe_position(area, i), layer),
                          max(area.level - 1.0, 0.0));
    return sum / float(probes_of(area));
}

mat2 inverse_of(vec3 covariance) {
    float determinant =
        max(covariance.x * covariance.y - covariance.z * covariance.z, 1e-14);
    return mat2(covariance.y, -covariance.z, -covariance.z, covariance.x) / determinant;
}

// Gaussians that a bin consists of.
int term_count() {
    return distribution_kind() == DISTRIBUTION_GGX ? MAXIMUM_TERMS : BIN_WIDTHS ? 2 : 1;
}

// The median variance and, returned, the variance of log sqrt(v), for base lobes whose deviations
// vary log-normally: mean(1/sqrt(v))^2 = exp(varies) / median, mean(v) = exp(2 varies) median.
float width_statistics(inout plane_bin bin) {
    bin.variance = 1.0 / (bin.sharpness * bin.sharpness);
    if (!BIN_WIDTHS) {
        bin.mean_variance = bin.variance;
        return 0.0;
    }
    float ratio = clamp(bin.mean_variance / bin.variance, 1.0, exp(3.0 * TAIL_VARIES_MAXIMUM));
    float varies = log(ratio) / 3.0;
    bin.variance *= exp(varies);
    return varies;
}

// The base lobe's own shape, which no sum of Gaussians matches exactly. While the normals spread
// little compared to it, the bin has this shape too.
void keep_shape(inout plane_bin bin, float varies) {
    float variance = bin.variance + bin.spread;
    float own = bin.variance / variance;
    float square = own * own;
    bin.own = square * square * square * square;
    float deviation = exp(sqrt(varies));
    for (int i = 0; i < (BIN_WIDTHS ? 2 : 1); ++i) {
        float one = bin.spread + (!BIN_WIDTHS ? bin.variance
                                  : i == 0    ? bin.variance / (deviation * deviation)
                                              : bin.variance * deviation * deviation);
        bin.own_parameter[i] = parameter_of_plane_variance(distribution_kind(), one);
        bin.own_share[i] = (BIN_WIDTHS ? 0.5 : 1.0) * bin.mass /
                           plane_mass(MODEL, distribution_kind(), bin.own_parameter[i]);
    }
}

// The normals' Gaussian, convolved with the base lobes, of variances `base` at their median.
void make_terms(inout plane_bin bin, vec3 covariance, vec3 base, float varies) {
    vec4 weight, spread;
    if (distribution_kind() == DISTRIBUTION_GGX) {
        weight = tail_weight(varies);
        spread = tail_spread(varies);
    } else {
        float factor = exp(2.0 * sqrt(varies));
        weight = vec4(BIN_WIDTHS ? 0.5 : 1.0);
        spread = vec4(1.0 / factor, factor, 1.0, 1.0);
    }
    for (int i = 0; i < term_count(); ++i)
        bin.terms[i] = make_plane_gaussian(covariance + spread[i] * base, weight[i] * bin.mass);
}

// Meshes tint metal, but not what a dielectric reflects (glTF 2.0, appendix B.2: 4 %).
vec3 colour_of_bin(surface_point surface, vec4 fetched) {
    if (MODEL != MODEL_MICROFACET)
        return fetched.rgb;
    return 0.04 * fetched.a + (VERTEX_COLOUR ? fetched.rgb * surface.colour.rgb : fetched.rgb);
}

plane_bin read_bin(surface_point surface, map_area area, uint index) {
    uint layers = BIN_COLOUR ? 3u : 2u;
    vec4 place = fetch_moments(area, layers * index);
    vec4 spread = fetch_moments(area, layers * index + 1u);
    float scale = 1.0 / max(place.x, 1e-6);
    vec4 range = binning.bins[index].range;
    plane_bin bin;
    bin.mass = place.x * binning.largest.x;
    vec2 mean = place.yz * scale;
    bin.mean = mean * range.z + range.xy;
    bin.axis = direction_from_plane(bin.mean);
    bin.sharpness = max(place.w * scale * range.w, 0.4);
    bin.mean_variance = spread.w * scale * binning.bins[index].shape.w;
    float varies = width_statistics(bin);
    vec3 covariance =
        covariance_of(mean, spread.xyz * scale) * (range.z * range.z) + surface.curvature;
    vec3 base = bin.variance * plane_distortion(bin.mean);
    bin.covariance = covariance + base;
    bin.gain = mat2(covariance.x, covariance.z, covariance.z, covariance.y) *
               inverse_of(covariance + base);
    make_terms(bin, covariance, base, varies);
    bin.spread = 0.5 * (covariance.x + covariance.y);
    keep_shape(bin, varies);
    if (BIN_COLOUR)
        bin.colour = colour_of_bin(surface, fetch_moments(area, layers * index + 2u) *
                                                vec4(vec3(scale * binning.largest.y), scale));
    return bin;
}

float evaluate_own_shape(vec3 axis, vec3 halfway, float parameter) {
    return MODEL == MODEL_MICROFACET
               ? normal_distribution(distribution_kind(), axis, halfway, parameter)
               : half_vector_lobe(distribution_kind(), halfway, axis, parameter);
}

void add_bin_to_light(inout light_sum sum, plane_bin bin, vec3 halfway, vec2 place) {
    vec2 d = place - bin.mean;
    float value = 0.0;
    for (int i = 0; i < term_count(); ++i)
        value += evaluate_plane_gaussian(bin.terms[i], d);
    float own = bin.own_share.x * evaluate_own_shape(bin.axis, halfway, bin.own_parameter.x);
    if (BIN_WIDTHS)
        own += bin.own_share.y * evaluate_own_shape(bin.axis, halfway, bin.own_parameter.y);
    value = mix(value, own, bin.own);
    sum.distribution += value;
    sum.sharpness += value * bin.sharpness;
    // If normals and base lobes are Gaussian, so are the normals for a given half vector.
    if (MODEL == MODEL_MICROFACET)
        sum.normal += value * direction_from_plane(bin.mean + bin.gain * d);
    if (BIN_COLOUR)
        sum.colour += value * bin.colour;
}

#endif
