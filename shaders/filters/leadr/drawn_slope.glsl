#ifndef DRAWN_SLOPE_GLSL
#define DRAWN_SLOPE_GLSL

// The mean slope of a footprint on triangles that a relief displaces.

#include "shading/slope_maps.glsl"
#include "lib/microfacet/seen_slopes.glsl"

float trace(vec3 covariance) {
    return covariance.x + covariance.y;
}

// Where pixels are smaller than triangles, undrawn relief is larger than a pixel, too: such slopes
// would be seen more often if they face the viewer. The footprint's mean moves to where it is in
// the distribution of those. `between`: moments of what is finer than triangles; `share`: the part
// of it that is larger than the pixel.
vec2 mean_on_triangles(slope_moments moments, slope_moments between, float share,
                       surface_point surface) {
    float own = trace(moments.covariance), undrawn = trace(between.covariance);
    slope_distribution larger = slope_distribution_of(
        between.mean,
        share * max(undrawn - own, 0.0) / max(undrawn, 1e-12) * between.covariance);
    vec2 mean =
        slope_that_is_seen(moments.mean, larger,
                           height_above_slope(surface.drawn_slope, surface.outgoing),
                           surface.outgoing);
    return facing_slope(mean, surface);
}

#endif
