#ifndef LIB_SLOPE_DISTRIBUTION_GLSL
#define LIB_SLOPE_DISTRIBUTION_GLSL

#include "interface/slope_moments.h"
#include "lib/number/constants.glsl"

// Gaussian distributions of slopes, (x, y) = -n_xy/n_z, and the distributions of normals that
// belong to them. A covariance is (xx, yy, xy).
//
// Olano, Baker, 2010, LEAN Mapping; Dupuy, Heitz, Iehl, Poulin, Neyret, Ostromoukhov, 2013, Linear
// Efficient Antialiased Displacement and Reflectance Mapping, section 4.1.

// Dupuy et al., 2013, Eq. 11 and the text before it. At most SLOPE_MAXIMUM long; a normal straight
// down has no slope, and is given none.
vec2 slope_of_normal(vec3 normal) {
    float planar = length(normal.xy);
    return normal.xy / -max(max(normal.z, planar / SLOPE_MAXIMUM), 1e-30);
}

vec3 normal_of_slope(vec2 slope) {
    return normalize(vec3(-slope, 1.0));
}

// Dupuy et al., 2013, Eq. 9. Rounding must not make a variance negative.
vec3 covariance_of_moments(vec2 mean, vec3 second) {
    return vec3(max(second.xy - mean * mean, vec2(0.0)), second.z - mean.x * mean.y);
}

// Slopes of another frame, to first order: covariance of M s for a symmetric M, (xx, yy, xy) too.
vec3 transformed_covariance(vec3 symmetric, vec3 covariance) {
    mat2 m = mat2(symmetric.x, symmetric.z, symmetric.z, symmetric.y);
    mat2 c = m * mat2(covariance.x, covariance.z, covariance.z, covariance.y) * m;
    return vec3(c[0][0], c[1][1], c[0][1]);
}

// A Gaussian with the lower triangle of its covariance's Cholesky factor, (xx, yy, xy): sums of
// squares take the place of differences, and none of its quotients is 0/0.
struct slope_distribution {
    vec2 mean;
    vec3 root;
};

// Slopes vary at least by a microradian.
const float SLOPE_VARIANCE_MINIMUM = 1e-12;

slope_distribution slope_distribution_of(vec2 mean, vec3 covariance) {
    vec2 variance = max(covariance.xy, vec2(SLOPE_VARIANCE_MINIMUM));
    // No more correlated than is possible, which r_xy = c_xy/(sigma_x sigma_y) of a flat map is.
    float correlated = sqrt(variance.x * variance.y);
    slope_distribution result;
    result.mean = mean;
    result.root.x = sqrt(variance.x);
    result.root.z = clamp(covariance.z, -correlated, correlated) / result.root.x;
    result.root.y =
        sqrt(max(variance.y - result.root.z * result.root.z, SLOPE_VARIANCE_MINIMUM));
    return result;
}

// The slope in units of the distribution: normally distributed with variance one, uncorrelated.
vec2 standardised_slope(slope_distribution slopes, vec2 slope) {
    vec2 difference = slope - slopes.mean;
    float x = difference.x / slopes.root.x;
    return vec2(x, (difference.y - slopes.root.z * x) / slopes.root.y);
}

// The inverse.
vec2 slope_at(slope_distribution slopes, vec2 standardised) {
    return slopes.mean + vec2(slopes.root.x * standardised.x,
                              slopes.root.z * standardised.x + slopes.root.y * standardised.y);
}

// Variance along a direction of the plane that need not be of unit length. Dupuy et al., 2013,
// Eq. 15.
float slope_variance_along(slope_distribution slopes, vec2 direction) {
    vec2 image = vec2(slopes.root.x * direction.x + slopes.root.z * direction.y,
                      slopes.root.y * direction.y);
    return dot(image, image);
}

// The same of a covariance.
float variance_along(vec3 covariance, vec2 direction) {
    return max(dot(covariance.xy, direction * direction) +
                   2.0 * covariance.z * direction.x * direction.y,
               0.0);
}

// P_22, Dupuy et al., 2013, Eq. 8: per unit of slopes' area.
float slope_density(slope_distribution slopes, vec2 slope) {
    vec2 standardised = standardised_slope(slopes, slope);
    return 0.5 * INVERSE_PI * exp(-0.5 * dot(standardised, standardised)) /
           (slopes.root.x * slopes.root.y);
}

// Dupuy et al., 2013, Eq. 10: D(n) = P_22(n)/n_z^4, of projected area one; the Beckmann
// distribution where the mean is zero and the covariance alpha^2/2 each way.
float distribution_of_slopes(slope_distribution slopes, vec3 normal) {
    float cosine = max(normal.z, COSINE_MINIMUM);
    float square = cosine * cosine;
    return normal.z > 0.0 ? slope_density(slopes, normal.xy / -cosine) / (square * square) : 0.0;
}

// The same of area one: the Jacobian of slopes alone, 1/n_z^3.
float lobe_of_slopes(slope_distribution slopes, vec3 normal) {
    return max(normal.z, 0.0) * distribution_of_slopes(slopes, normal);
}

#endif
