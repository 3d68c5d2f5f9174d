#ifndef LIB_SEEN_SLOPES_GLSL
#define LIB_SEEN_SLOPES_GLSL

#include "lib/microfacet/slope_masking.glsl"

// Gaussian slopes that are seen from a direction: each as often as its facets show area to it.

// E[<direction, (-s, 1)>^+], by Smith's Lambda about the slopes' own mean: h (1 + Lambda), h the
// height above that mean, and where the direction is below it |h| Lambda. `variance`: of the slopes
// along the direction.
float mean_height(float height, float variance) {
    float deviation = sqrt(max(variance, 1e-30));
    float distance = max(abs(height), 1e-3 * deviation); // Lambda is infinite at 0
    return max(height, 0.0) + distance * lambda_gaussian(distance / (1.41421356 * deviation));
}

// Of normal distribution; to 3e-4.
float part_below(float deviations) {
    float d = clamp(deviations, -5.0, 5.0);
    return 0.5 + 0.5 * tanh(0.797884561 * (d + 0.044715 * d * d * d));
}

// Where a slope of a Gaussian is in the distribution of those that are seen, which is taken for a
// Gaussian, too. With z the deviation of a slope towards the direction, in standard deviations, its
// facets show an area of (c + z)^+ for a height of c standard deviations above the mean, so that
// with A = E[(c + z)^+] and the normal distribution's Phi and density phi
//   E[z (c + z)^+]/A = Phi(c)/A,  E[z^2 (c + z)^+]/A = 1 + phi(c)/A.
// `height`: of the direction above the mean slope.
vec2 slope_that_is_seen(vec2 slope, slope_distribution all, float height, vec3 direction) {
    vec2 image = vec2(all.root.x * direction.x + all.root.z * direction.y,
                      all.root.y * direction.y);
    float deviation = length(image);
    if (deviation < 1e-4)
        return slope;
    float c = clamp(height / deviation, -1.5, 30.0);
    float area = mean_height(c, 1.0), density = 0.39894228 * exp(-0.5 * c * c);
    float mean = part_below(c) / area;
    float spread = sqrt(max(1.0 + density / area - mean * mean, 0.0));
    float place = -dot(slope - all.mean, direction.xy) / deviation;
    vec2 towards = vec2(all.root.x * image.x, all.root.z * image.x + all.root.y * image.y);
    return slope - towards / deviation * (mean + (spread - 1.0) * place);
}

// The part of the facets that a direction sees.
float masking_of_slopes(slope_distribution slopes, vec3 outgoing) {
    return height_above_slope(slopes.mean, outgoing) > 0.0
               ? 1.0 / (1.0 + lambda_of_slopes(slopes, outgoing))
               : 0.0;
}

// The part of what is seen that light reaches, heights correlated (Dupuy et al. 2013, Eq. 13).
float shadowing_of_seen_slopes(slope_distribution slopes, vec3 incoming, vec3 outgoing) {
    if (height_above_slope(slopes.mean, incoming) <= 0.0)
        return 0.0;
    float seen = 1.0 + lambda_of_slopes(slopes, outgoing);
    return seen / (seen + lambda_of_slopes(slopes, incoming));
}

#endif
