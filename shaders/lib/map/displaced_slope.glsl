#ifndef LIB_DISPLACED_SLOPE_GLSL
#define LIB_DISPLACED_SLOPE_GLSL

#include "interface/waves.h"

// A surface whose point at x is moved to (x + D(x), h(x)), with D = grad of a potential.

struct displaced_slope {
    float area; // J, of the surface's projection, relative to that of x; 0 where it has folded
    vec2 slope; // of the height over the place where the point is
};

// `gradients`: dh/dx, dh/dy, dD_x/dx, dD_y/dy; `shear`: dD_x/dy = dD_y/dx. The slope is
// (I + dD)^-T grad h, as the chain rule says.
displaced_slope displaced_slope_of(vec4 gradients, float shear) {
    float x = 1.0 + gradients.z, y = 1.0 + gradients.w;
    displaced_slope result;
    result.area = max(x * y - shear * shear, 0.0);
    vec2 moved = vec2(y * gradients.x - shear * gradients.y, x * gradients.y - shear * gradients.x);
    result.slope = moved / max(result.area, 1e-3);
    result.slope *= min(1.0, WAVE_SLOPE_MAXIMUM / max(length(result.slope), 1e-30));
    return result;
}

// What a map of waves keeps of it, see interface/waves.h.
vec4 first_wave_moments(displaced_slope waves) {
    return waves.area * vec4(1.0, waves.slope, 0.0);
}

vec4 second_wave_moments(displaced_slope waves) {
    vec2 slope = waves.slope;
    return waves.area * vec4(slope * slope, slope.x * slope.y, 0.0);
}

#endif
