#ifndef LIB_FACING_NORMALS_GLSL
#define LIB_FACING_NORMALS_GLSL

#include "lib/lobe/direction_lobe.glsl"
#include "lib/lobe/lambert_plane.glsl"
#include "lib/lobe/plane_gaussian.glsl"

// Normals under a pixel that face the viewer and the light. The others reflect nothing, and at
// grazing angles they are many.

// Normals in the Lambert plane.
struct normal_spread {
    vec3 mean;       // of the normals, at most of unit length
    vec2 place;      // mean of their places
    vec3 covariance; // (xx, yy, xy) of their places
};

// `second_moments`: (xx, yy, xy) about the origin. The mean of 1 - |q|^2 / 2 is exactly that of the
// normals' third coordinate.
normal_spread normal_spread_of(vec2 place, vec3 second_moments) {
    float height = sqrt(max(1.0 - 0.25 * dot(place, place), 0.05));
    normal_spread normals;
    normals.mean = vec3(height * place, 1.0 - 0.5 * (second_moments.x + second_moments.y));
    normals.place = place;
    normals.covariance = covariance_of(place, second_moments);
    return normals;
}

// How <n, direction> changes with the place of n (see direction_step).
vec2 cosine_gradient(vec2 place, vec3 direction) {
    float height = sqrt(max(1.0 - 0.25 * dot(place, place), 0.05));
    return height * direction.xy -
           (0.25 / height * dot(place, direction.xy) + direction.z) * place;
}

float covariance_along(vec3 covariance, vec2 a, vec2 b) {
    return dot(covariance, vec3(a * b, a.x * b.y + a.y * b.x));
}

// A normal number of this mean in standard deviations, cut off at 0. The distribution function is
// that of normal_below, and the density its derivative.
struct positive_part {
    float share;
    float shift;    // of the mean, in standard deviations
    float narrower; // by which the variance falls
};

positive_part positive_part_of(float mean) {
    // Below -3 nothing is left, and the shift would be close to -x.
    float x = clamp(mean, -3.0, 10.0), square = x * x;
    float below = 1.0 / (1.0 + exp(1.5957691 * x * (1.0 + 0.044715 * square)));
    float shift = 1.5957691 * (1.0 + 0.134145 * square) * below;
    return positive_part(mean > -3.0 ? 1.0 - below : 0.0, shift,
                         clamp(shift * (shift + x), 0.0, 0.95));
}

// The same weighted with itself, as areas are by how large they appear.
positive_part weighted_by_itself(positive_part part, float mean) {
    float shift = 1.0 / max(clamp(mean, -3.0, 10.0) + part.shift, 0.1);
    return positive_part(part.share, shift,
                         clamp(shift * (shift - part.shift), 0.0, 0.95));
}

// Normals weighted by their cosine to a direction, as Gaussian again (see lobe_above).
normal_spread moved_normals(normal_spread normals, vec3 direction, bool by_area, out float share) {
    vec2 gradient = cosine_gradient(normals.place, direction);
    float scale = inversesqrt(
        max(covariance_along(normals.covariance, gradient, gradient), 1e-10));
    float mean = scale * dot(normals.mean, direction);
    positive_part part = positive_part_of(mean);
    if (by_area)
        part = weighted_by_itself(part, mean);
    vec2 slope = scale * vec2(dot(normals.covariance.xz, gradient),
                              dot(normals.covariance.zy, gradient));
    share = part.share;
    normals.mean += part.shift * direction_step(normals.place, slope);
    normals.covariance -= part.narrower * vec3(slope * slope, slope.x * slope.y);
    return normals;
}

// The normals that face a direction, all alike.
normal_spread facing_normals(normal_spread normals, vec3 direction, out float share) {
    return moved_normals(normals, direction, false, share);
}

// The normals of facets as large as they appear from a direction. `share`: of those that face it.
normal_spread seen_normals(normal_spread normals, vec3 direction, out float share) {
    return moved_normals(normals, direction, true, share);
}

// The mean of max(<n, direction>, 0).
float mean_facing_cosine(normal_spread normals, vec3 direction) {
    vec2 gradient = cosine_gradient(normals.place, direction);
    float deviation =
        sqrt(max(covariance_along(normals.covariance, gradient, gradient), 1e-10));
    float mean = dot(normals.mean, direction);
    positive_part part = positive_part_of(mean / deviation);
    return part.share * max(mean + deviation * part.shift, 0.0);
}

// Of the normals that face both directions.
struct facing_cosines {
    float share;
    float incoming, outgoing; // means
};

facing_cosines facing_cosines_of(normal_spread normals, vec3 incoming, vec3 outgoing) {
    float seen, lit;
    normals = facing_normals(facing_normals(normals, outgoing, seen), incoming, lit);
    return facing_cosines(seen * lit, max(dot(normals.mean, incoming), 0.0),
                          max(dot(normals.mean, outgoing), 0.0));
}

#endif
