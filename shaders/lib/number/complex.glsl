#ifndef LIB_COMPLEX_GLSL
#define LIB_COMPLEX_GLSL

#include "lib/number/constants.glsl"

// Complex numbers (real, imaginary).

vec2 conjugate(vec2 a) {
    return vec2(a.x, -a.y);
}

vec2 times_i(vec2 a) {
    return vec2(-a.y, a.x);
}

vec2 times(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// e^(2 pi i turns), turns in units of 2^-32, to 1e-7 on every device: Taylor's series within an
// eighth of a turn. A device's own sine may be off by 2^-11.
vec2 turned(uint turns) {
    // The nearest quarter, and the rest in [-1/8, 1/8) of a turn.
    uint quarter = (turns + 0x20000000u) >> 30u;
    float x = float(int(turns - (quarter << 30u))) * (2.0 * PI / 4294967296.0);
    float s = x * x;
    float sine = x * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 +
                                                                      s / 362880.0))));
    float cosine = 1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s / 40320.0)));
    vec2 rest = vec2(cosine, sine);
    rest = (quarter & 1u) != 0u ? times_i(rest) : rest;
    return (quarter & 2u) != 0u ? -rest : rest;
}

#endif
