#include "passes/context/sample_pattern.h"

#include <math.h>

/// The bits of `index` mirrored at the binary point: 1, 2, 3 give 0.5, 0.25, 0.75.
float passes_radical_inverse(uint32_t index) {
    float result = 0, digit = 0.5f;
    for (; index; index >>= 1, digit *= 0.5f)
        result += (float)(index & 1) * digit;
    return result;
}

void passes_sample_position(uint32_t index, uint32_t count, float position[2]) {
    // Half a stratum, so that the points' mean is the centre.
    uint32_t strata = 1;
    while (strata < count)
        strata *= 2;
    position[0] = ((float)index + 0.5f) / (float)count;
    position[1] = passes_radical_inverse(index) + 0.5f / (float)strata;
}

void passes_sample_position_around_centre(uint32_t index, float position[2]) {
    // 64ths of a pixel. Found by a random search for the least squared error of the part of a pixel
    // on one side of a straight edge, over edges of all directions and distances, with the first
    // four and with all eight: 0.0094 and 0.0028. Of one sample it is 0.062, of the best four and
    // eight rooks 0.0082 and 0.0031.
    static const uint8_t positions[SAMPLES_AROUND_CENTRE][2] = {
        {32, 32}, {56, 51}, {30, 6}, {8, 43}, {7, 16}, {43, 40}, {22, 56}, {55, 13}};
    for (int i = 0; i < 2; i++)
        position[i] = (float)positions[index][i] / 64;
}

void passes_sample_position_in_pattern(uint32_t pattern, float position[2]) {
    // Inverse powers of the root of x^3 = x + 1, the plane's golden ratio: they keep patterns
    // apart.
    static const double step[2] = {0.7548776662466927, 0.5698402909980532};
    const float below_one = 0x1.fffffep-1f;
    for (int i = 0; pattern != 0 && i < 2; i++) {
        double moved = (double)position[i] + pattern * step[i];
        position[i] = fminf((float)(moved - floor(moved)), below_one);
    }
}

double passes_hashed_number(uint64_t index) {
    // Steele, Lea, Flood 2014, Fast Splittable Pseudorandom Number Generators: SplitMix64.
    uint64_t z = (index + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

void passes_spread_position(uint32_t index, uint32_t count, double position[2]) {
    const uint32_t cell[2] = {index, index * 5 % count};
    for (uint32_t axis = 0; axis < 2; axis++)
        position[axis] = (cell[axis] + passes_hashed_number(2 * (uint64_t)index + axis)) / count;
}
