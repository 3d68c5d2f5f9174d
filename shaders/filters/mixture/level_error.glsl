#ifndef LEVEL_ERROR_GLSL
#define LEVEL_ERROR_GLSL

// How far components are from all lobes under a texel of a level.

#include "filters/mixture/level_sums.glsl"
#include "filters/mixture/overlap.glsl"

// The squared difference between all components and all lobes, integrated over the plane, without
// what does not depend on the components.
float squared_error(level_box box, mixture_units units,
                    mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    float own = 0.0, lobes = 0.0, whole = 0.0;
    for (int k = 0; k < BINS; ++k)
        for (int j = 0; j < BINS; ++j)
            own += components[k].part * overlap(components[j], as_sample(components[k]), units);
    for (uint y = box.low.y; y < box.high.y; ++y) {
        for (uint x = box.low.x; x < box.high.x; ++x) {
            float weight = weight_of(box, uvec2(x, y));
            for (int i = 0; i < LOBE_COUNT; ++i) {
                mixture_sample lobe = read_sample(ivec2(x, y), i, units);
                whole += weight * lobe.mass;
                for (int j = 0; j < BINS; ++j)
                    lobes += weight * lobe.mass * overlap(components[j], lobe, units);
            }
        }
    }
    return own - 2.0 * lobes / max(whole, 1e-20);
}

#endif
