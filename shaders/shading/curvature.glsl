#ifndef CURVATURE_GLSL
#define CURVATURE_GLSL

// What includes this file has the block `knobs`.

// A larger variance means that the pixel is at a silhouette, where derivatives are meaningless.
const float CURVATURE_MAXIMUM = 0.1;

// Covariance of the macro-surface's normal over the sample's box, from its change along both sides,
// assuming that it changes linearly: a box of width one has the variance 1/12.
vec3 normal_covariance(vec2 dx, vec2 dy) {
    vec3 covariance = (knobs.curvature / 12.0) * vec3(dx * dx + dy * dy, dx.x * dx.y + dy.x * dy.y);
    float variance = max(covariance.x, covariance.y);
    return covariance * min(1.0, CURVATURE_MAXIMUM / max(variance, 1e-30));
}

#endif
