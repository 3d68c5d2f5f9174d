#include "engine/image/half.h"

#include <math.h>
#include <string.h>

uint16_t engine_half_from_float(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint16_t sign = (uint16_t)(bits >> 16 & 0x8000u);
    float magnitude = fabsf(value);
    if (isnan(value))
        return sign | 0x7e00u;
    if (magnitude >= 65520.0f) // halfway between the largest number and the next power of two
        return sign | 0x7c00u;
    if (magnitude < 0x1p-14f) // subnormal: a multiple of 2^-24; may round up to the first normal
        return sign | (uint16_t)lrintf(magnitude * 0x1p24f);
    // Drop 13 bits of fraction, rounded; a carry moves into the exponent, as it should.
    uint32_t rounded = (bits & 0x7fffffffu) + 0x0fffu + (bits >> 13 & 1u);
    return sign | (uint16_t)((rounded >> 13) - ((127u - 15u) << 10));
}

float engine_half_to_float(uint16_t half) {
    uint32_t exponent = half >> 10 & 0x1fu;
    uint32_t fraction = half & 0x3ffu;
    uint32_t sign = (uint32_t)(half & 0x8000u) << 16;
    uint32_t bits;
    if (exponent == 0) {
        float magnitude = (float)fraction * 0x1p-24f;
        memcpy(&bits, &magnitude, sizeof bits);
    } else if (exponent == 31) {
        bits = 0x7f800000u | fraction << 13;
    } else {
        bits = (exponent + 127u - 15u) << 23 | fraction << 13;
    }
    bits |= sign;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}
