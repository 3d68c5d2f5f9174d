#ifndef LIB_DIRECTION_LOBE_GLSL
#define LIB_DIRECTION_LOBE_GLSL

#include "lib/number/constants.glsl"

// Gaussian lobes of directions, and how reflection and a horizon change them.

// About a unit axis. Two vectors perpendicular to it, not necessarily to each other, give the
// displacement of a direction for one standard deviation of two independent numbers: the covariance
// is first first^T + second second^T.
struct direction_lobe {
    vec3 axis;
    vec3 first, second;
};

// A unit vector perpendicular to `axis`, in the plane of both if there is one.
vec3 perpendicular_towards(vec3 axis, vec3 other) {
    vec3 planar = other - axis * dot(axis, other);
    float square = dot(planar, planar);
    if (square < 1e-10) {
        vec3 any = abs(axis.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
        planar = any - axis * dot(axis, any);
        square = dot(planar, planar);
    }
    return planar * inversesqrt(square);
}

// The same in all directions; `first` lies in the plane of the axis and `outgoing`.
direction_lobe isotropic_lobe(vec3 axis, float deviation, vec3 outgoing) {
    vec3 planar = perpendicular_towards(axis, outgoing);
    return direction_lobe(axis, deviation * planar, deviation * cross(axis, planar));
}

// Variance in any one direction: the geometric mean of the largest and the smallest.
float lobe_variance(direction_lobe lobe) {
    return length(cross(lobe.first, lobe.second));
}

// The lobe of incoming directions for one of half vectors h, to first order:
//   i = 2 <o, h> h - o,   di = 2 <o, dh> h + 2 <o, h> dh.
// It is twice as broad in the plane of reflection, and across it 2 <o, h> times, which is what
// makes reflections at grazing angles long. Wang, Ren, Gong, Snyder, Guo, 2009, All-Frequency
// Rendering of Dynamic, Spatially-Varying Reflectance, section 4.2, keep the area, 4 <o, h>, and
// let the lobe be round.
direction_lobe reflected_lobe(direction_lobe half_vectors, vec3 outgoing) {
    float cosine = dot(outgoing, half_vectors.axis);
    direction_lobe incoming;
    incoming.axis = 2.0 * cosine * half_vectors.axis - outgoing;
    incoming.first = 2.0 * (dot(outgoing, half_vectors.first) * half_vectors.axis +
                            cosine * half_vectors.first);
    incoming.second = 2.0 * (dot(outgoing, half_vectors.second) * half_vectors.axis +
                             cosine * half_vectors.second);
    return incoming;
}

// The same lobe with perpendicular displacements, the longer one first (one Jacobi rotation).
direction_lobe principal_lobe(direction_lobe lobe) {
    float difference = dot(lobe.first, lobe.first) - dot(lobe.second, lobe.second);
    float mixed = 2.0 * dot(lobe.first, lobe.second);
    float length_of_both = sqrt(difference * difference + mixed * mixed);
    // Cosine and sine of half the angle, the larger first, without a difference of close numbers;
    // no rotation if the lobe is round.
    float scale = length_of_both > 0.0 ? 1.0 / length_of_both : 0.0;
    float larger = sqrt(scale > 0.0 ? 0.5 + 0.5 * min(abs(difference) * scale, 1.0) : 1.0);
    float smaller = 0.5 * abs(mixed) * scale / larger;
    float cosine = difference >= 0.0 ? larger : smaller;
    float sine = difference >= 0.0 ? smaller : larger;
    sine = mixed < 0.0 ? -sine : sine;
    return direction_lobe(lobe.axis, cosine * lobe.first + sine * lobe.second,
                          cosine * lobe.second - sine * lobe.first);
}

// Distribution function of a normal number, to 3e-4: Page, 1977, Approximations to the Cumulative
// Normal Function and its Inverse for Use on a Pocket Calculator.
float normal_below(float x) {
    return 0.5 + 0.5 * tanh(clamp(0.7978845608 * (x + 0.044715 * x * x * x), -10.0, 10.0));
}

float normal_density(float x) {
    return 0.39894228 * exp(-0.5 * x * x);
}

// The height of the axis above a plane, in standard deviations of the lobe's height.
float lobe_height(direction_lobe lobe, vec3 plane_normal) {
    float a = dot(lobe.first, plane_normal);
    float b = dot(lobe.second, plane_normal);
    return dot(lobe.axis, plane_normal) * inversesqrt(max(a * a + b * b, 1e-20));
}

// The fraction of a lobe above a plane.
float lobe_share_above(direction_lobe lobe, vec3 plane_normal) {
    return normal_below(lobe_height(lobe, plane_normal));
}

// The part above a plane, as a Gaussian again. For a normal number cut off at -x (Johnson, Kotz,
// Balakrishnan, 1994, Continuous Univariate Distributions, section 10.1), with q = phi(x)/Phi(x),
//   mean q,   variance 1 - q (q + x).
direction_lobe lobe_above(direction_lobe lobe, vec3 plane_normal) {
    float a = dot(lobe.first, plane_normal);
    float b = dot(lobe.second, plane_normal);
    float deviation = sqrt(max(a * a + b * b, 1e-20));
    // Below -3 nothing is left, and the quotient is close to -x.
    float x = max(dot(lobe.axis, plane_normal) / deviation, -3.0);
    float mean = normal_density(x) / max(normal_below(x), 1e-3);
    float variance = clamp(1.0 - mean * (mean + x), 0.05, 1.0);
    vec3 upwards = (a * lobe.first + b * lobe.second) / deviation;
    vec3 level = (a * lobe.second - b * lobe.first) / deviation;
    return direction_lobe(normalize(lobe.axis + mean * upwards), sqrt(variance) * upwards, level);
}

// What is left of a normal number of variance 1 where the part below `top` fades in proportion to
// nothing at 0. With that weight f, the share is E[f], the shift E[f'] / E[f], and the variance
// 1 + E[f''] / E[f] less the square of the shift.
struct faded_part {
    float share;
    float shift;    // of the mean
    float variance; // of what is left
};

// The mean of max(x, 0) for a normal number of variance 1, less max(mean, 0).
float mean_beyond_zero(float mean) {
    float x = min(abs(mean), 10.0);
    return normal_density(x) - x * normal_below(-x);
}

// The share is a difference of two means of max(x, 0), which far above `top` are all but equal.
faded_part faded_below(float mean, float top) {
    float width = max(top, 1e-3), scale = 1.0 / width;
    float x = max(mean, -3.0), y = x - width;
    float bend = scale * (normal_density(x) - normal_density(y));
    faded_part part;
    part.share = max(clamp(scale * x, 0.0, 1.0) +
                         scale * (mean_beyond_zero(x) - mean_beyond_zero(y)),
                     1e-4);
    part.shift = max(scale * (normal_below(x) - normal_below(y)), 0.0) / part.share;
    part.variance = clamp(1.0 + bend / part.share - part.shift * part.shift, 0.05, 1.0);
    return part;
}

// The mean of max(x, 0) for a normal number.
float mean_above_zero(float mean, float deviation) {
    float x = mean / max(deviation, 1e-10);
    return max(mean * normal_below(x) + deviation * normal_density(x), 0.0);
}

#endif
