#ifndef PLANE_BIN_GLSL
#define PLANE_BIN_GLSL

// Normals under a pixel as a Gaussian of the Lambert plane, convolved with the base lobes: what it
// reflects of a light. Whoever includes this declares two constants before: BIN_COLOUR, whether
// each bin has a colour of its own, and BIN_WIDTHS, whether the widths of base lobes vary in a bin.

#include "lib/lobe/lambert_plane.glsl"
#include "lib/lobe/plane_gaussian.glsl"
#include "lib/lobe/plane_lobe.glsl"
#include "lib/microfacet/facing_normals.glsl"

#ifdef ENVIRONMENT
#include "environment/microfacets.glsl"
#endif

// Sums over the bins for one light.
struct light_sum {
    float distribution;
    // Of the texels that reflect, weighted by their part of the distribution:
    vec2 place;          // of the normals
    vec3 second_moments; // (xx, yy, xy) of their places
    float sharpness;     // of their base lobes; where `reflected` is set, weighted by that,
    vec3 colour;         // as colours are
    vec3 exchanged_and_diffuse; // of closed surfaces
    // Of surfaces that are not closed, with their masking, over 4 <n, omega_o>:
    float reflected;
    float outgoing; // the texels' <n, omega_o>, weighted by that
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
    vec3 places;         // the same without base lobes: of the normals' places
    plane_gaussian terms[MAXIMUM_TERMS]; // the first term_count()
    float own;           // [0, 1]: how much of the bin has the base lobe's exact shape
    vec2 own_parameter;  // of base lobes as broad as the bin: of the sharper and the broader half
    vec2 own_share;
    vec3 colour;
    float dielectric; // of bins with colours: the part that is not metal
};

uint distribution_kind() {
    return BASE_AS_LOBE ? DISTRIBUTION_VMF : DISTRIBUTION;
}

// Gaussians that a bin consists of.
int term_count() {
    return distribution_kind() == DISTRIBUTION_GGX ? MAXIMUM_TERMS : BIN_WIDTHS ? 2 : 1;
}

// The variances of two base lobes, each of half of the bin, that have the means of 1 / sqrt(v) and
// of v. With m their geometric mean and deviations of exp(-s) and exp(s) times its root:
//   m mean(1 / sqrt(v))^2 = cosh(s)^2, mean(v) = cosh(2 s) m.
vec2 halves_of_widths(plane_bin bin, float ratio) {
    float square = 0.25 + 0.25 * sqrt(1.0 + 8.0 * ratio);
    float factor = sqrt(square) + sqrt(square - 1.0); // exp(s)
    return square / (bin.sharpness * bin.sharpness) *
           vec2(1.0 / (factor * factor), factor * factor);
}

// Sets the median variance. Returned are those of two halves, and the variance of log sqrt(v) for
// base lobes with tails, which vary log-normally:
//   median mean(1 / sqrt(v))^2 = exp(s^2), mean(v) = exp(2 s^2) median.
// Where that is more than terms can follow, the mean of v is kept: rough texels are seen far from
// the highlight, and the sharpest hardly anywhere.
vec2 width_statistics(inout plane_bin bin, out float varies) {
    bin.variance = 1.0 / (bin.sharpness * bin.sharpness);
    varies = 0.0;
    if (!BIN_WIDTHS) {
        bin.mean_variance = bin.variance;
        return vec2(bin.variance);
    }
    float ratio = clamp(bin.mean_variance / bin.variance, 1.0, 1e8);
    vec2 halves = halves_of_widths(bin, ratio);
    if (distribution_kind() == DISTRIBUTION_GGX) {
        varies = min(log(ratio) / 3.0, TAIL_VARIES_MAXIMUM);
        bin.variance *= ratio * exp(-2.0 * varies);
    } else {
        bin.variance = sqrt(halves.x * halves.y);
    }
    return halves;
}

// The base lobe's own shape, which no sum of Gaussians matches exactly. While the normals spread
// little compared to it, the bin has this shape too.
void keep_shape(inout plane_bin bin, vec2 halves) {
    float variance = bin.variance + bin.spread;
    float own = bin.variance / variance;
    float square = own * own;
    bin.own = square * square * square * square;
    for (int i = 0; i < (BIN_WIDTHS ? 2 : 1); ++i) {
        bin.own_parameter[i] =
            parameter_of_plane_variance(distribution_kind(), bin.spread + halves[i]);
        bin.own_share[i] = (BIN_WIDTHS ? 0.5 : 1.0) * bin.mass /
                           plane_mass(MODEL, distribution_kind(), bin.own_parameter[i]);
    }
}

// The normals' Gaussian, convolved with the base lobes: of GGX of variances `base` at their median,
// else of two halves.
void make_terms(inout plane_bin bin, vec3 covariance, vec3 base, vec2 halves, float varies) {
    vec4 weight, spread;
    if (distribution_kind() == DISTRIBUTION_GGX) {
        weight = tail_weight(varies);
        spread = tail_spread(varies);
    } else {
        weight = vec4(BIN_WIDTHS ? 0.5 : 1.0);
        spread = vec4(halves / bin.variance, 1.0, 1.0);
    }
    for (int i = 0; i < term_count(); ++i)
        bin.terms[i] = make_plane_gaussian(covariance + spread[i] * base, weight[i] * bin.mass);
}

vec3 second_moments_of(vec2 place) {
    return vec3(place * place, place.x * place.y);
}

float evaluate_own_shape(vec3 axis, vec3 halfway, float parameter) {
    return MODEL == MODEL_MICROFACET
               ? normal_distribution(distribution_kind(), axis, halfway, parameter)
               : half_vector_lobe(distribution_kind(), halfway, axis, parameter);
}

// Of GGX as Student's t distribution in the plane, |q|^2 stands for the sine squared,
// |q|^2 (1 - |q|^2 / 4): far from its axis a base lobe is brighter than that.
float ggx_beyond_plane(float variance, float square) {
    float e = 2.0 * variance;
    float ratio = (e + square) / (e + square * (1.0 - 0.25 * min(square, 2.0)));
    return ratio * ratio;
}

// The normals that reflect about a half vector. If normals and base lobes are Gaussian, so are
// these: with covariances C and B they are at mean + C (C + B)^-1 d, and C - C (C + B)^-1 C is
// their covariance. (C + B)^-1 is the mean over the terms.
struct reflecting_places {
    vec2 mean;
    vec3 covariance;
};

reflecting_places reflecting_places_of(plane_bin bin, vec3 inverse, vec2 d) {
    mat2 places = mat2(bin.places.x, bin.places.z, bin.places.z, bin.places.y);
    mat2 gain = places * mat2(inverse.x, inverse.z, inverse.z, inverse.y);
    mat2 left = places - gain * places;
    return reflecting_places(bin.mean + gain * d, vec3(left[0][0], left[1][1], left[0][1]));
}

// GGX beyond the bin's broadest term, where the terms fall off too fast. Of widths that vary the
// mean variance counts there.
float ggx_tail(plane_bin bin, vec2 d) {
    vec3 exponent = bin.terms[MAXIMUM_TERMS - 1].exponent;
    if (dot(exponent, vec3(d * d, d.x * d.y)) > -TAIL_BEGINS)
        return 0.0;
    return bin.mass * density_of_tail(2.0 * bin.mean_variance, d, bin.places);
}

// The sum of the terms; `inverse`: the mean of their inverse covariances.
float evaluate_terms(plane_bin bin, vec2 d, out vec3 inverse) {
    float value = 0.0;
    vec3 exponent = vec3(0.0);
    for (int i = 0; i < term_count(); ++i) {
        float term = evaluate_plane_gaussian(bin.terms[i], d);
        value += term;
        exponent += term * bin.terms[i].exponent;
    }
    if (distribution_kind() == DISTRIBUTION_GGX)
        value = max(value, ggx_tail(bin, d));
    inverse = vec3(-2.0, -2.0, -1.0) / max(value, 1e-30) * exponent;
    return value;
}

float evaluate_own_shapes(plane_bin bin, vec3 halfway) {
    float value = bin.own_share.x * evaluate_own_shape(bin.axis, halfway, bin.own_parameter.x);
    if (BIN_WIDTHS)
        value += bin.own_share.y * evaluate_own_shape(bin.axis, halfway, bin.own_parameter.y);
    return value;
}

// What a bin has of half vectors, and the normals of its texels that reflect about one of them.
float evaluate_bin(plane_bin bin, vec3 halfway, vec2 place, out reflecting_places reflecting) {
    vec2 d = place - bin.mean;
    vec3 inverse;
    float value = evaluate_terms(bin, d, inverse);
    reflecting = reflecting_places_of(bin, inverse, d);
    if (distribution_kind() == DISTRIBUTION_GGX)
        value *= ggx_beyond_plane(
            bin.variance, difference_squared(direction_from_plane(reflecting.mean), halfway) +
                              reflecting.covariance.x + reflecting.covariance.y);
    return mix(value, evaluate_own_shapes(bin, halfway), bin.own);
}

void add_bin_to_light(inout light_sum sum, plane_bin bin, vec3 halfway, vec2 place) {
    reflecting_places reflecting;
    float value = evaluate_bin(bin, halfway, place, reflecting);
    sum.distribution += value;
    sum.sharpness += value * bin.sharpness;
    if (MODEL == MODEL_MICROFACET) {
        sum.place += value * reflecting.mean;
        sum.second_moments +=
            value * (reflecting.covariance + second_moments_of(reflecting.mean));
    }
    if (BIN_COLOUR)
        sum.colour += value * bin.colour;
}

// Of surfaces that are not closed. Each bin is masked by itself: where half of the facets face
// away, as on steep ridges seen from the side, no common Gaussian tells which.
void add_masked_bin(inout light_sum sum, plane_bin bin, vec3 halfway, vec2 place, vec3 outgoing,
                    vec3 incoming) {
    reflecting_places reflecting;
    float value = evaluate_bin(bin, halfway, place, reflecting);
    facing_cosines cosines = facing_cosines_of(
        normal_spread_of(reflecting.mean,
                         reflecting.covariance + second_moments_of(reflecting.mean)),
        incoming, outgoing);
    float width = parameter_of_plane_variance(DISTRIBUTION, 1.0 / (bin.sharpness * bin.sharpness));
    float visible = masking_shadowing(DISTRIBUTION, cosines.incoming, cosines.outgoing, width);
    float reflected =
        microfacet_specular(vec3(1.0), cosines.share * value, visible, cosines.outgoing).x;
    sum.reflected += reflected;
    sum.outgoing += reflected * cosines.outgoing;
    sum.sharpness += reflected * bin.sharpness;
    if (BIN_COLOUR)
        sum.colour += reflected * bin.colour;
}

// A bin's share of the appearance. For microfacets as seen along the normal, where a lobe's mass is
// more than one.
float part_of_bin(plane_bin bin) {
    if (MODEL == MODEL_HALF_VECTOR_LOBES)
        return bin.mass;
    float parameter = parameter_of_plane_variance(distribution_kind(), bin.mean_variance);
    return bin.mass / plane_mass(MODEL, distribution_kind(), parameter);
}

// The slope of a node of normals that are Gaussian in the plane.
vec2 slope_in_plane(vec2 mean, vec3 covariance, int node) {
    float x = sqrt(max(covariance.x, 1e-12)), shear = covariance.z / x;
    float y = sqrt(max(covariance.y - shear * shear, 1e-12));
    vec2 place = slope_node(node);
    return slope_of_normal(
        direction_from_plane(mean + vec2(x * place.x, shear * place.x + y * place.y)));
}

#ifdef ENVIRONMENT
// A bin as a lobe of half vectors: the covariance of its places, mapped to the sphere.
direction_lobe lobe_of_bin(plane_bin bin, vec3 covariance) {
    float x = sqrt(max(covariance.x, 1e-12));
    float shared_part = covariance.z / x;
    float y = sqrt(max(covariance.y - shared_part * shared_part, 1e-12));
    return direction_lobe(bin.axis, direction_step(bin.mean, vec2(x, shared_part)),
                          direction_step(bin.mean, vec2(0.0, y)));
}

// GGX keeps its long tails, however far the normals of a bin spread. Without them the error of
// metal is a fifth larger (relative L1 of scratched metal in a courtyard: 0.070 instead of 0.058;
// blending both in proportion is no better).
vec3 reflect_bin(surface_point surface, plane_bin bin, vec3 f0, facet_view view) {
    bool tails = MODEL == MODEL_MICROFACET && distribution_kind() == DISTRIBUTION_GGX;
    uint kind = tails ? DISTRIBUTION_GGX : DISTRIBUTION_VMF;
    if (MODEL == MODEL_HALF_VECTOR_LOBES)
        return reflect_half_vectors(
            surface, half_vector_distribution(lobe_of_bin(bin, bin.covariance), kind));
    // Broad base lobes have another variance in the plane than on the sphere.
    float parameter = parameter_of_plane_variance(DISTRIBUTION, bin.variance);
    float excess = bin.variance - 1.0 / base_lobe_concentration(DISTRIBUTION, parameter);
    vec3 covariance = bin.covariance - excess * plane_distortion(bin.mean);
    half_vector_distribution lobe =
        half_vector_distribution(lobe_of_bin(bin, covariance), kind);
    return reflect_microfacets(surface, lobe, f0, parameter, view);
}
#endif

#endif
