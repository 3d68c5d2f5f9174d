#include "passes/sample_pattern.h"

/// The bits of `index` mirrored at the binary point: 1, 2, 3 give 0.5, 0.25, 0.75.
static float radical_inverse(uint32_t index) {
    float result = 0, digit = 0.5f;
    for (; index; index >>= 1, digit *= 0.5f)
        result += (float)(index & 1) * digit;
    return result;
}

void sample_position(uint32_t index, uint32_t count, float position[2]) {
    // Half a stratum, so that the points' mean is the centre.
    uint32_t strata = 1;
    while (strata < count)
        strata *= 2;
    position[0] = ((float)index + 0.5f) / (float)count;
    position[1] = radical_inverse(index) + 0.5f / (float)strata;
}
