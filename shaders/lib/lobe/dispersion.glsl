#ifndef LIB_DISPERSION_GLSL
#define LIB_DISPERSION_GLSL

#include "lib/number/constants.glsl"

// How much of a mean lobe's breadth comes from parts that point in different directions. The length
// |r_M| alone, the measure of Xu et al., 2017, Algorithm 1, cannot distinguish that from broad
// parts (their section 5.3); together with their mean length it can:
//   (mean |r_i| - |r_M|) / (1 - mean |r_i|) = (s_M - s) / s,
//   s_M = 1 - |r_M|,   s = mean (1 - |r_i|)
// 0: all point the same way; 1: the different directions double the breadth. Both arguments in [0,
// 1].
float dispersion(float mean_complement, float resultant_complement) {
    float base = max(mean_complement, 1.0 / CONCENTRATION_MAXIMUM);
    return max(resultant_complement - base, 0.0) / base;
}

// 0 below threshold - half_width, 1 above threshold + half_width, smooth between; a step for a half
// width of 0. Switching hard jumps by 44 % of the peak when a lobe crosses the threshold.
float transition(float measure, float threshold, float half_width) {
    float position = half_width > 0.0 ? 0.5 + 0.5 * (measure - threshold) / half_width
                                      : step(threshold, measure);
    float t = clamp(position, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

#endif
