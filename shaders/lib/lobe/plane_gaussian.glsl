#ifndef LIB_PLANE_GAUSSIAN_GLSL
#define LIB_PLANE_GAUSSIAN_GLSL

#include "lib/number/constants.glsl"

// A Gaussian of covariance (xx, yy, xy) in a plane, as its peak and what multiplies the squares of
// a distance in the exponent: value = peak exp(xx d_x d_x + yy d_y d_y + xy d_x d_y).
struct plane_gaussian {
    float peak;
    vec3 exponent;
};

plane_gaussian make_plane_gaussian(vec3 covariance, float mass) {
    // Rounding may make a covariance singular: 1e-12 is far below the sharpest lobe's.
    float determinant =
        max(covariance.x * covariance.y - covariance.z * covariance.z, 1e-14);
    plane_gaussian result;
    result.peak = mass * (0.5 * INVERSE_PI) * inversesqrt(determinant);
    result.exponent = vec3(-0.5 * covariance.y, -0.5 * covariance.x, covariance.z) / determinant;
    return result;
}

float evaluate_plane_gaussian(plane_gaussian bell, vec2 distance) {
    return bell.peak * exp(dot(bell.exponent, vec3(distance * distance, distance.x * distance.y)));
}

// Covariance from moments about a point: never negative, and the correlation never above one,
// despite rounding.
vec3 covariance_of(vec2 mean, vec3 second_moments) {
    vec3 covariance = second_moments - vec3(mean * mean, mean.x * mean.y);
    covariance.xy = max(covariance.xy, vec2(0.0));
    float limit = sqrt(covariance.x * covariance.y);
    covariance.z = clamp(covariance.z, -limit, limit);
    return covariance;
}

#endif
