#include "tests/reference/microfacet/microfacet.h"

#include <math.h>

#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/reference/vector.h"

// Directions count as no closer to the horizon than this: shaders/lib/number/constants.glsl.
static const double cosine_minimum = 1e-6;

static double tangent_squared(double cosine) {
    double c = fmax(cosine, cosine_minimum);
    return fmax(1 / (c * c) - 1, 0);
}

static double ggx(double cosine_squared, double sine_squared, double alpha) {
    double slope = sine_squared / cosine_squared / (alpha * alpha);
    return 1 / (M_PI * alpha * alpha * pow(cosine_squared, 2) * pow(1 + slope, 2));
}

static double beckmann(double cosine_squared, double sine_squared, double alpha) {
    double slope = sine_squared / cosine_squared / (alpha * alpha);
    return exp(-slope) / (M_PI * alpha * alpha * pow(cosine_squared, 2));
}

double reference_von_mises_fisher_projected_area(double kappa) {
    return 0.5 * (1 + reference_mean_resultant_length(0.5 * kappa)) / (1 + exp(-kappa));
}

double reference_normal_distribution(lobe_distribution distribution, const double normal[3],
                                     const double half_vector[3], double parameter) {
    double cosine = reference_dot(normal, half_vector);
    if (cosine <= 0)
        return 0;
    double difference = reference_distance_squared(normal, half_vector);
    double sine_squared = difference * (1 - difference / 4);
    double cosine_squared = fmax(cosine * cosine, cosine_minimum * cosine_minimum);
    switch (distribution) {
    case LOBE_DISTRIBUTION_GGX:
        return ggx(cosine_squared, sine_squared, parameter);
    case LOBE_DISTRIBUTION_BECKMANN:
        return beckmann(cosine_squared, sine_squared, parameter);
    case LOBE_DISTRIBUTION_BLINN_PHONG:
        return (parameter + 2) / (2 * M_PI) * pow(1 - difference / 2, parameter);
    default:
        return reference_von_mises_fisher(half_vector, normal, parameter) /
               reference_von_mises_fisher_projected_area(parameter);
    }
}

static double alpha_for_masking(lobe_distribution distribution, double parameter) {
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return sqrt(2 / (parameter + 2));
    if (distribution == LOBE_DISTRIBUTION_VMF)
        return sqrt(2 / (parameter + 1));
    return parameter;
}

double reference_smith_lambda(lobe_distribution distribution, double cosine, double parameter) {
    double alpha = alpha_for_masking(distribution, parameter);
    double slope_squared = alpha * alpha * tangent_squared(cosine);
    if (distribution == LOBE_DISTRIBUTION_GGX)
        return (sqrt(1 + slope_squared) - 1) / 2;
    if (slope_squared == 0)
        return 0;
    double a = 1 / sqrt(slope_squared);
    return (exp(-a * a) / (a * sqrt(M_PI)) - erfc(a)) / 2;
}

double reference_masking(lobe_distribution distribution, double cosine, double parameter) {
    return cosine > 0 ? 1 / (1 + reference_smith_lambda(distribution, cosine, parameter)) : 0;
}

double reference_masking_shadowing(lobe_distribution distribution, double incident_cosine,
                                   double outgoing_cosine, double parameter) {
    if (incident_cosine <= 0 || outgoing_cosine <= 0)
        return 0;
    return 1 / (1 + reference_smith_lambda(distribution, incident_cosine, parameter) +
                reference_smith_lambda(distribution, outgoing_cosine, parameter));
}

double reference_fresnel(double f0, double f90, double cosine) {
    return f0 + (f90 - f0) * pow(1 - fmin(fmax(cosine, 0), 1), 5);
}

double reference_microfacet_specular(double fresnel, double distribution, double masking_shadowing,
                                     double outgoing_cosine) {
    return fresnel * distribution * masking_shadowing / (4 * fmax(outgoing_cosine, cosine_minimum));
}

double reference_microfacet_diffuse(double albedo, double fresnel, double incident_cosine) {
    return albedo / M_PI * (1 - fresnel) * fmax(incident_cosine, 0);
}
