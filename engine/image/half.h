#ifndef ENGINE_IMAGE_HALF_H
#define ENGINE_IMAGE_HALF_H

#include <stdint.h>

/// 16-bit floats (IEEE 754 binary16): 5 bits of exponent, 10 bits of fraction.

/// Largest finite value.
#define ENGINE_HALF_MAXIMUM 65504.0f

/// Rounds to nearest, ties to even; overflows to infinity; NaN stays NaN.
uint16_t engine_half_from_float(float value);

/// Exact.
float engine_half_to_float(uint16_t half);

#endif
