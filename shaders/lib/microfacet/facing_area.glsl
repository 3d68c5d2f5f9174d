#ifndef LIB_FACING_AREA_GLSL
#define LIB_FACING_AREA_GLSL

#include "lib/microfacet/facing_normals.glsl"

// What facets show of themselves to many directions, without exponentials: their normals as means
// and covariances of directions, so that a cosine to any direction is a normal number whose mean
// and variance are a linear and a quadratic form.

struct facet_spread {
    float area;
    vec3 mean;     // of the normals, at most of unit length
    vec3 squares;  // their covariance: xx, yy, zz
    vec3 products; // yz, zx, xy
};

facet_spread facet_spread_of(normal_spread normals, float area) {
    vec3 x = direction_step(normals.place, vec2(1.0, 0.0)),
         y = direction_step(normals.place, vec2(0.0, 1.0));
    vec3 c = normals.covariance;
    return facet_spread(area, normals.mean, c.x * x * x + c.y * y * y + 2.0 * c.z * x * y,
                        c.x * x.yzx * x.zxy + c.y * y.yzx * y.zxy +
                            c.z * (x.yzx * y.zxy + y.yzx * x.zxy));
}

// The covariance of the normals with their cosine to a direction.
vec3 covariance_with_cosine(facet_spread facets, vec3 direction) {
    return facets.squares * direction + facets.products.zxy * direction.yzx +
           facets.products.yzx * direction.zxy;
}

// Of a normal number x: how often it is positive, and the mean of max(x, 0), within 0.003
// deviations. Beyond 0 on either side both fall as powers of the distance from where they end.
struct positive_mean {
    float share;
    float value;
    float deviation;
};

positive_mean positive_mean_of(float mean, float variance) {
    const float DEVIATIONS = 3.165, FACTOR = 0.125 / (DEVIATIONS * DEVIATIONS * DEVIATIONS);
    variance = max(variance, 1e-10);
    float scale = inversesqrt(variance), deviation = variance * scale;
    float beyond = max(DEVIATIONS - scale * abs(mean), 0.0);
    float part = 4.0 * FACTOR * beyond * beyond * beyond;
    return positive_mean(mean > 0.0 ? 1.0 - part : part,
                         max(mean, 0.0) + 0.25 * part * beyond * deviation, deviation);
}

// Of facets that face a direction, hidden or not, as they appear from there.
float facing_area(facet_spread facets, vec3 direction) {
    float variance = dot(facets.squares, direction * direction) +
                     2.0 * dot(facets.products, direction.yzx * direction.zxy);
    return facets.area * positive_mean_of(dot(facets.mean, direction), variance).value;
}

// Facets as large as they appear from a direction.
struct seen_facets {
    float area;
    vec3 mean;    // of their normals
    float spread; // the trace of these normals' covariance
};

// Of normals weighted by their positive cosine x to a direction, the mean moves along their
// covariance with x by P(x > 0) / E(max(x, 0)), which is that of a Gaussian, and the variance
// falls as that of x does.
seen_facets seen_facets_of(facet_spread facets, vec3 direction) {
    vec3 covariance = covariance_with_cosine(facets, direction);
    float mean = dot(facets.mean, direction), variance = max(dot(covariance, direction), 1e-10);
    positive_mean cosine = positive_mean_of(mean, variance);
    float shift = cosine.share / max(cosine.value, 0.1 * cosine.deviation * cosine.share + 1e-12);
    float narrower = clamp(shift * (shift * variance + mean) - 1.0, 0.0, 0.95);
    float spread = facets.squares.x + facets.squares.y + facets.squares.z -
                   narrower * dot(covariance, covariance) / variance;
    return seen_facets(facets.area * cosine.value, facets.mean + shift * covariance,
                       max(spread, 0.0));
}

#endif
