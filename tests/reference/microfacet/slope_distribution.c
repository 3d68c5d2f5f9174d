#include "tests/reference/microfacet/slope_distribution.h"

#include <math.h>

#include "shaders/interface/slope_moments.h"

void reference_slope_of_normal(const double normal[3], double slope[2]) {
    double planar = hypot(normal[0], normal[1]);
    slope[0] = slope[1] = 0;
    if (planar == 0)
        return;
    double length = normal[2] > 0 ? fmin(planar / normal[2], SLOPE_MAXIMUM) : SLOPE_MAXIMUM;
    for (int i = 0; i < 2; i++)
        slope[i] = -normal[i] / planar * length;
}

void reference_normal_of_slope(const double slope[2], double normal[3]) {
    normal[2] = 1 / sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
    normal[0] = -slope[0] * normal[2];
    normal[1] = -slope[1] * normal[2];
}

/// Density per unit of slopes' area. The covariance must be invertible.
static double slope_density(const reference_slopes *slopes, const double slope[2]) {
    const double *c = slopes->covariance;
    double determinant = c[0] * c[1] - c[2] * c[2];
    double x = slope[0] - slopes->mean[0], y = slope[1] - slopes->mean[1];
    double form = (c[1] * x * x - 2 * c[2] * x * y + c[0] * y * y) / determinant;
    return exp(-form / 2) / (2 * M_PI * sqrt(determinant));
}

double reference_distribution_of_slopes(const reference_slopes *slopes, const double normal[3]) {
    if (normal[2] <= 0)
        return 0;
    const double slope[2] = {-normal[0] / normal[2], -normal[1] / normal[2]};
    return slope_density(slopes, slope) / pow(normal[2], 4);
}

double reference_lobe_of_slopes(const reference_slopes *slopes, const double normal[3]) {
    return fmax(normal[2], 0) * reference_distribution_of_slopes(slopes, normal);
}

/// Dupuy et al., 2013, section 4.3, as printed. Straight up, nothing is masked.
double reference_slope_lambda(const reference_slopes *slopes, const double direction[3]) {
    double sine = hypot(direction[0], direction[1]);
    if (sine == 0)
        return 0;
    double x = direction[0] / sine, y = direction[1] / sine;
    const double *c = slopes->covariance;
    double mean = x * slopes->mean[0] + y * slopes->mean[1];
    double variance = x * x * c[0] + y * y * c[1] + 2 * x * y * c[2];
    double cotangent = direction[2] / sine - mean;
    if (cotangent <= 0)
        return INFINITY;
    if (variance <= 0)
        return 0;
    double a = cotangent / sqrt(2 * variance);
    return fmax((exp(-a * a) / (a * sqrt(M_PI)) - erfc(a)) / 2, 0);
}

double reference_slope_masking_shadowing(const reference_slopes *slopes, const double incoming[3],
                                         const double outgoing[3]) {
    return 1 / (1 + reference_slope_lambda(slopes, incoming) +
                reference_slope_lambda(slopes, outgoing));
}

/// covariance of `along` times the part along the tilt and `across` times the rest.
static void scale_along_and_across(const double tilt[2], double along, double across,
                                   const double covariance[3], double scaled[3]) {
    double length = hypot(tilt[0], tilt[1]);
    double x = length > 0 ? tilt[0] / length : 1, y = length > 0 ? tilt[1] / length : 0;
    double xx = covariance[0], yy = covariance[1], xy = covariance[2];
    double aa = along * along * (x * x * xx + y * y * yy + 2 * x * y * xy);
    double bb = across * across * (y * y * xx + x * x * yy - 2 * x * y * xy);
    double ab = along * across * (x * y * (yy - xx) + (x * x - y * y) * xy);
    scaled[0] = x * x * aa + y * y * bb - 2 * x * y * ab;
    scaled[1] = y * y * aa + x * x * bb + 2 * x * y * ab;
    scaled[2] = x * y * (aa - bb) + (x * x - y * y) * ab;
}

void reference_tilted_covariance(const double tilt[2], const double covariance[3],
                                 double tilted[3]) {
    double cosine = cos(atan(hypot(tilt[0], tilt[1])));
    scale_along_and_across(tilt, cosine * cosine, cosine, covariance, tilted);
}

void reference_flat_covariance(const double tilt[2], double variance, double covariance[3]) {
    double cosine = cos(atan(hypot(tilt[0], tilt[1])));
    const double round[3] = {variance, variance, 0};
    scale_along_and_across(tilt, 1 / (cosine * cosine), 1 / cosine, round, covariance);
}
