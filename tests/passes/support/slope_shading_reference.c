#include "tests/passes/support/slope_shading_reference.h"

#include <math.h>

#include "tests/passes/support/shading_reference.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/microfacet/slope_distribution.h"
#include "tests/reference/vector.h"

static double fresnel_of(const lobe_material *material, int channel, const double incoming[3],
                         const double half_vector[3]) {
    if (material->model == LOBE_MATERIAL_HALF_VECTOR_LOBES)
        return 0;
    double metallic = (double)material->metallic;
    double f0 = 0.04 * (1 - metallic) + (double)material->base_colour[channel] * metallic;
    return reference_fresnel(f0, 1, reference_dot(incoming, half_vector));
}

/// Albedo of the Lambert part, less what the surface above it reflects.
static double diffuse_of(const lobe_material *material, int channel, const double incoming[3],
                         const double half_vector[3]) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    double metallic = microfacet ? (double)material->metallic : 0;
    return (double)material->base_colour[channel] * (1 - metallic) *
           (1 - fresnel_of(material, channel, incoming, half_vector));
}

static double colour_of_lobes(const lobe_material *material, int channel) {
    double sum = 0;
    for (uint32_t i = 0; i < material->lobe_count; i++)
        sum += (double)material->lobes[i].colour[channel];
    return sum;
}

static double parameter_of_variance(lobe_distribution distribution, double variance) {
    switch (distribution) {
    case LOBE_DISTRIBUTION_BLINN_PHONG:
        return fmax(1 / variance - 1, 0);
    case LOBE_DISTRIBUTION_VMF:
        return 1 / variance;
    default:
        return sqrt(2 * variance);
    }
}

/// Moments of a footprint's directions and the variance of its base lobes.
static void read_moments(const double moments[8], reference_slopes *slopes, double *variance) {
    const double *first = moments, *second = moments + 4;
    for (int i = 0; i < 2; i++) {
        slopes->mean[i] = first[i];
        slopes->covariance[i] = fmax(second[i] - first[i] * first[i], 0);
    }
    slopes->covariance[2] = second[2] - first[0] * first[1];
    *variance = first[3];
}

/// Olano, Baker 2010, over the plane of the mean normal.
typedef struct lean_lobe {
    double axes[3][3];     ///< of that plane, and the mean normal
    reference_slopes lobe; ///< over that plane, base lobes included
    double covariance[3];  ///< the same without base lobes
    double variance;       ///< of base lobes
    double half_vector[3]; ///< in those axes
} lean_lobe;

static lean_lobe lean_lobe_of(const double moments[8], const double half_vector[3]) {
    reference_slopes slopes;
    lean_lobe result = {.lobe = {{0}, {0}}};
    read_moments(moments, &slopes, &result.variance);
    double normal[3];
    reference_normal_of_slope(slopes.mean, normal);
    for (int i = 0; i < 3; i++) {
        const double axis[3] = {i == 0, i == 1, i == 2};
        reference_rotate_from_pole(normal, axis, result.axes[i]);
        result.half_vector[i] = reference_dot(result.axes[i], half_vector);
    }
    reference_tilted_covariance(slopes.mean, slopes.covariance, result.covariance);
    for (int i = 0; i < 3; i++)
        result.lobe.covariance[i] = result.covariance[i] + (i < 2 ? result.variance : 0);
    return result;
}

/// Mean slope of the texels whose slope and base lobe's together are that of the half vector:
/// C (C + b I)^-1 s.
static void reflecting_normal(const lean_lobe *lean, double normal[3]) {
    double height = fmax(lean->half_vector[2], 1e-6);
    double x = -lean->half_vector[0] / height, y = -lean->half_vector[1] / height;
    const double *c = lean->covariance, *all = lean->lobe.covariance;
    double determinant = all[0] * all[1] - all[2] * all[2];
    double u = (all[1] * x - all[2] * y) / determinant;
    double v = (all[0] * y - all[2] * x) / determinant;
    double local[3];
    reference_normal_of_slope((double[]){c[0] * u + c[2] * v, c[2] * u + c[1] * v}, local);
    for (int i = 0; i < 3; i++)
        normal[i] =
            local[0] * lean->axes[0][i] + local[1] * lean->axes[1][i] + local[2] * lean->axes[2][i];
}

/// The Lambert part about the mean direction, as long as the normals' mean n_z makes it.
static void add_lambert(const lobe_material *material, const double moments[8],
                        const double half_vector[3], const double incoming[3], double radiance[3]) {
    double cosine =
        moments[2] * (incoming[2] - moments[0] * incoming[0] - moments[1] * incoming[1]);
    for (int i = 0; i < 3; i++)
        radiance[i] += diffuse_of(material, i, incoming, half_vector) / M_PI * fmax(cosine, 0);
}

void shade_lean(const lobe_material *material, const double moments[8], const double outgoing[3],
                const double incoming[3], double radiance[3]) {
    radiance[0] = radiance[1] = radiance[2] = 0;
    if (incoming[2] <= 0)
        return;
    double half_vector[3];
    half_between(incoming, outgoing, half_vector);
    lean_lobe lean = lean_lobe_of(moments, half_vector);
    if (material->model == LOBE_MATERIAL_HALF_VECTOR_LOBES) {
        double lobe = reference_lobe_of_slopes(&lean.lobe, lean.half_vector);
        for (int i = 0; i < 3; i++)
            radiance[i] = colour_of_lobes(material, i) * lobe;
        add_lambert(material, moments, half_vector, incoming, radiance);
        return;
    }
    double normal[3];
    reflecting_normal(&lean, normal);
    double in = reference_dot(normal, incoming), out = reference_dot(normal, outgoing);
    if (in <= 0 || out <= 0)
        return;
    double parameter = parameter_of_variance(material->distribution, lean.variance);
    double value = reference_microfacet_specular(
        1,
        reference_lobe_of_slopes(&lean.lobe, lean.half_vector) /
            fmax(reference_dot(normal, half_vector), 1e-6),
        reference_masking_shadowing(material->distribution, in, out, parameter), out);
    for (int i = 0; i < 3; i++)
        radiance[i] = value * fresnel_of(material, i, incoming, half_vector);
    add_lambert(material, moments, half_vector, incoming, radiance);
}

// ---------------------------------------------------------------------------------------------
// LEADR

static double height_above(const double slope[2], const double direction[3]) {
    return direction[2] - slope[0] * direction[0] - slope[1] * direction[1];
}

/// Dupuy et al. 2013, Algorithm 3 with the weights of section 5.1, of Lambert facets of albedo one.
static double sum_of_facets(const reference_slopes *facets, const leadr_knobs *knobs,
                            const double outgoing[3], const double incoming[3]) {
    const double *c = facets->covariance;
    double sigma_x = sqrt(c[0]), sigma_y = sqrt(c[1]), sum = 0, weights = 0;
    double correlation = sigma_x * sigma_y > 0 ? c[2] / (sigma_x * sigma_y) : 0;
    for (int j = 0; j < knobs->grid * knobs->grid; j++) {
        double p = knobs->reach * (2.0 * (j / knobs->grid) / (knobs->grid - 1) - 1);
        double q = knobs->reach * (2.0 * (j % knobs->grid) / (knobs->grid - 1) - 1);
        double weight = exp(-p * p / 2) * exp(-q * q / 2), normal[3];
        double independent = sqrt(fmax(1 - correlation * correlation, 0));
        const double slope[2] = {p * sigma_x + facets->mean[0],
                                 (correlation * p + independent * q) * sigma_y + facets->mean[1]};
        reference_normal_of_slope(slope, normal);
        sum += weight * fmax(reference_dot(normal, outgoing), 0) / normal[2] *
               fmax(reference_dot(normal, incoming), 0);
        weights += weight;
    }
    return sum / weights / M_PI;
}

/// What a texel mirrors, over its share of the light and F/4, times how large the texel is.
static double mirrored_by_texel(const lobe_material *material, const double slope[2],
                                double variance, const double half_vector[3],
                                const double outgoing[3], const double incoming[3]) {
    const double parameter = parameter_of_variance(material->distribution, variance);
    // The other distributions become Beckmann's of equal variance.
    const bool ggx = material->distribution == LOBE_DISTRIBUTION_GGX;
    double normal[3];
    reference_normal_of_slope(slope, normal);
    return reference_normal_distribution(ggx ? LOBE_DISTRIBUTION_GGX : LOBE_DISTRIBUTION_BECKMANN,
                                         normal, half_vector, sqrt(2 * variance)) *
           reference_masking_shadowing(material->distribution, reference_dot(normal, incoming),
                                       reference_dot(normal, outgoing), parameter) /
           normal[2];
}

/// The mean over texels of Gaussian slopes, by the midpoint rule to 5 deviations.
static double mirrored_by_texels(const lobe_material *material, const reference_slopes *facets,
                                 double variance, const double half_vector[3],
                                 const double outgoing[3], const double incoming[3]) {
    enum { STEPS = 80 };
    const double *c = facets->covariance, reach = 5;
    const double first = sqrt(fmax(c[0], 1e-12)), mixed = c[2] / first,
                 second = sqrt(fmax(c[1] - mixed * mixed, 1e-12));
    double sum = 0, weights = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        const double x = reach * (2 * (i / STEPS + 0.5) / STEPS - 1),
                     y = reach * (2 * (i % STEPS + 0.5) / STEPS - 1);
        const double weight = exp(-0.5 * (x * x + y * y));
        const double slope[2] = {facets->mean[0] + first * x,
                                 facets->mean[1] + mixed * x + second * y};
        weights += weight;
        sum +=
            weight * mirrored_by_texel(material, slope, variance, half_vector, outgoing, incoming);
    }
    return sum / weights;
}

/// D times masking and shadowing of facets that mirror.
static double mirrors_of(const lobe_material *material, const leadr_knobs *knobs,
                         const reference_slopes *facets, double variance,
                         const double half_vector[3], const double outgoing[3],
                         const double incoming[3]) {
    if (!knobs->flat)
        return mirrored_by_texels(material, facets, variance, half_vector, outgoing, incoming) *
               reference_slope_masking_shadowing(facets, incoming, outgoing);
    reference_slopes slopes = *facets;
    for (int i = 0; i < 2; i++)
        slopes.covariance[i] += variance;
    return reference_distribution_of_slopes(&slopes, half_vector) *
           reference_slope_masking_shadowing(&slopes, incoming, outgoing);
}

void shade_leadr(const lobe_material *material, const leadr_knobs *knobs, const double moments[8],
                 const double outgoing[3], const double incoming[3], double radiance[3]) {
    radiance[0] = radiance[1] = radiance[2] = 0;
    reference_slopes facets, slopes;
    double variance, half_vector[3], base[3];
    read_moments(moments, &facets, &variance);
    for (int i = 0; i < 3; i++)
        facets.covariance[i] *= knobs->height * knobs->height;
    for (int i = 0; i < 2; i++)
        facets.mean[i] *= knobs->height;
    double out = height_above(facets.mean, outgoing), in = height_above(facets.mean, incoming);
    if (incoming[2] <= 0)
        return;
    half_between(incoming, outgoing, half_vector);
    slopes = facets;
    reference_flat_covariance(knobs->flat ? (double[]){0, 0} : facets.mean, variance, base);
    for (int i = 0; i < 3; i++)
        slopes.covariance[i] += base[i];
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    double seen = in > 0 && out > 0;
    double mirror =
        !microfacet ? reference_lobe_of_slopes(&slopes, half_vector)
        : seen > 0 ? mirrors_of(material, knobs, &facets, variance, half_vector, outgoing, incoming)
                   : 0;
    double lambert = seen * sum_of_facets(&facets, knobs, outgoing, incoming) / out *
                     reference_slope_masking_shadowing(&facets, incoming, outgoing);
    for (int i = 0; i < 3; i++) {
        if (microfacet)
            radiance[i] = mirror * fresnel_of(material, i, incoming, half_vector) / (4 * out);
        else
            radiance[i] = mirror * colour_of_lobes(material, i);
        radiance[i] += lambert * diffuse_of(material, i, incoming, half_vector);
    }
}

// ---------------------------------------------------------------------------------------------
// LEADR with several lobes

/// The mean of max(x, 0) for a normal number.
static double mean_above_zero(double mean, double deviation) {
    if (deviation <= 0)
        return fmax(mean, 0);
    const double x = mean / deviation;
    return 0.5 * mean * erfc(-x / sqrt(2)) + deviation * exp(-x * x / 2) / sqrt(2 * M_PI);
}

static double variance_along(const double covariance[3], const double direction[3]) {
    return covariance[0] * direction[0] * direction[0] +
           covariance[1] * direction[1] * direction[1] +
           2 * covariance[2] * direction[0] * direction[1];
}

static double area_above(const reference_slopes *slopes, const double direction[3]) {
    return mean_above_zero(height_above(slopes->mean, direction),
                           sqrt(fmax(variance_along(slopes->covariance, direction), 0)));
}

double multi_leadr_area_ratio(const slope_component *components, int count,
                              const double direction[3]) {
    double area = 0, height = 0;
    for (int i = 0; i < count; i++) {
        reference_slopes slopes;
        double variance;
        read_moments(components[i].moments, &slopes, &variance);
        area += components[i].part * area_above(&slopes, direction);
        height += components[i].part * height_above(slopes.mean, direction);
    }
    return area / height;
}

/// Base lobes become part of the components.
static void add_base(const slope_component *components, int count, slope_component *mirrors) {
    for (int i = 0; i < count; i++) {
        double base[3];
        mirrors[i] = components[i];
        reference_flat_covariance(components[i].moments, components[i].moments[3], base);
        for (int k = 0; k < 3; k++)
            mirrors[i].moments[4 + k] += base[k];
    }
}

/// Ashikhmin et al. 2000, as in Heitz 2014, section 5.3.
static double visibility_of_facets(const slope_component *components, int count,
                                   const double incoming[3], const double outgoing[3]) {
    const double in = multi_leadr_area_ratio(components, count, incoming) - 1;
    const double out = multi_leadr_area_ratio(components, count, outgoing) - 1;
    const double lengths = hypot(incoming[0], incoming[1]) * hypot(outgoing[0], outgoing[1]);
    double tau = 0;
    if (lengths > 0) {
        const double cosine = (incoming[0] * outgoing[0] + incoming[1] * outgoing[1]) / lengths;
        const double angle = acos(fmax(-1, fmin(1, cosine)));
        tau = 4.41 * angle / (4.41 * angle + 1);
    }
    return 1 / (1 + fmax(in, out) + tau * fmin(in, out));
}

typedef struct multi_leadr_sums {
    double lobe, facets; ///< of all components
    double in, out;      ///< heights above the mean plane
} multi_leadr_sums;

static multi_leadr_sums sum_components(const slope_component *components, int count,
                                       const leadr_knobs *knobs, const double outgoing[3],
                                       const double incoming[3], const double half_vector[3]) {
    multi_leadr_sums sums = {0};
    slope_component mirrors[8];
    add_base(components, count, mirrors);
    for (int i = 0; i < count; i++) {
        const double part = components[i].part;
        reference_slopes facets, slopes;
        double variance;
        read_moments(components[i].moments, &facets, &variance);
        read_moments(mirrors[i].moments, &slopes, &variance);
        sums.lobe += part * reference_lobe_of_slopes(&slopes, half_vector);
        sums.facets += part * sum_of_facets(&facets, knobs, outgoing, incoming);
        sums.in += part * height_above(facets.mean, incoming);
        sums.out += part * height_above(facets.mean, outgoing);
    }
    return sums;
}

static double mirrored_by_components(const lobe_material *material,
                                     const slope_component *components, int count,
                                     const double half_vector[3], const double outgoing[3],
                                     const double incoming[3]) {
    double sum = 0;
    for (int i = 0; i < count; i++) {
        reference_slopes facets;
        double variance;
        read_moments(components[i].moments, &facets, &variance);
        sum += components[i].part *
               mirrored_by_texels(material, &facets, variance, half_vector, outgoing, incoming);
    }
    return sum;
}

void shade_multi_leadr(const lobe_material *material, const leadr_knobs *knobs,
                       const slope_component *components, int count, const double outgoing[3],
                       const double incoming[3], double radiance[3]) {
    radiance[0] = radiance[1] = radiance[2] = 0;
    double half_vector[3];
    if (incoming[2] <= 0)
        return;
    half_between(incoming, outgoing, half_vector);
    const multi_leadr_sums sums =
        sum_components(components, count, knobs, outgoing, incoming, half_vector);
    const bool seen = sums.in > 0 && sums.out > 0;
    const bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    const double visible =
        seen ? visibility_of_facets(components, count, incoming, outgoing) / sums.out : 0;
    const double lambert = sums.facets * visible;
    double mirror = sums.lobe;
    if (microfacet)
        mirror =
            0.25 * visible *
            mirrored_by_components(material, components, count, half_vector, outgoing, incoming);
    for (int i = 0; i < 3; i++)
        radiance[i] = mirror * (microfacet ? fresnel_of(material, i, incoming, half_vector)
                                           : colour_of_lobes(material, i)) +
                      lambert * diffuse_of(material, i, incoming, half_vector);
}
