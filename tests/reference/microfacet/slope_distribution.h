#ifndef TESTS_REFERENCE_MICROFACET_SLOPE_DISTRIBUTION_H
#define TESTS_REFERENCE_MICROFACET_SLOPE_DISTRIBUTION_H

/// Gaussian distributions of slopes in double precision; see
/// shaders/lib/microfacet/slope_distribution.glsl, tilted_slopes.glsl and slope_masking.glsl. A
/// slope is (x, y) = -n_xy/n_z; a covariance is (xx, yy, xy).
typedef struct reference_slopes {
    double mean[2];
    double covariance[3];
} reference_slopes;

/// At most SLOPE_MAXIMUM long, (0, 0) for a normal straight down.
void reference_slope_of_normal(const double normal[3], double slope[2]);
void reference_normal_of_slope(const double slope[2], double normal[3]);

/// Distributions of unit normals: of projected area one, and of area one. The covariance must be
/// invertible.
double reference_distribution_of_slopes(const reference_slopes *slopes, const double normal[3]);
double reference_lobe_of_slopes(const reference_slopes *slopes, const double normal[3]);

/// Smith's Lambda about the mean, and the part of the surface that both directions see. Unit
/// directions.
double reference_slope_lambda(const reference_slopes *slopes, const double direction[3]);
double reference_slope_masking_shadowing(const reference_slopes *slopes, const double incoming[3],
                                         const double outgoing[3]);

/// Slopes whose own plane has the slope `tilt`, as angles along and across it: from slopes
/// over the flat plane to the tilted one, to first order about `tilt`.
void reference_tilted_covariance(const double tilt[2], const double covariance[3],
                                 double tilted[3]);
/// The inverse for a covariance that is `variance` each way over the tilted plane.
void reference_flat_covariance(const double tilt[2], double variance, double covariance[3]);

#endif
