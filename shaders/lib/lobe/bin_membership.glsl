#ifndef LIB_BIN_MEMBERSHIP_GLSL
#define LIB_BIN_MEMBERSHIP_GLSL

#include "interface/moment_bins.h"

// The share of a lobe that each bin gets: a partition of unity that depends only on the lobe, so
// that sums by bin are linear in the lobes and can be filtered. `place` is in the Lambert plane.

// Vasconcelos, Lippman, 1998, Learning Mixture Hierarchies, Eq. 8: the lobe as many points drawn
// from it; the likelihood of all of them under a component of the material's mixture.
float bin_likelihood(moment_bin bin, vec2 place, float variance) {
    vec2 d = place - bin.centre.xy;
    return bin.centre.z - dot(bin.shape.xyz, vec3(d * d, 2.0 * d.x * d.y)) -
           bin.centre.w * variance;
}

// Two hats that add up to one, across the middle.
float hat(float distance, float inverse_width) {
    return clamp(0.5 + distance * inverse_width, 0.0, 1.0);
}

// Product of hats in both directions: quarter `i` of the plane.
float quarter(int i, vec2 d, float inverse_width) {
    float x = hat((i & 1) == 0 ? d.x : -d.x, inverse_width);
    float y = hat((i & 2) == 0 ? d.y : -d.y, inverse_width);
    return x * y;
}

// A paraboloid around the middle, out to the width of a hat.
float cap(vec2 d, float inverse_width) {
    vec2 scaled = d * inverse_width;
    return clamp(1.0 - dot(scaled, scaled), 0.0, 1.0);
}

#endif
