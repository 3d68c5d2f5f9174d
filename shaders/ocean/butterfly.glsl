#ifndef BUTTERFLY_GLSL
#define BUTTERFLY_GLSL

// Fourier transforms of 2, 4 and 8 numbers with e^(+i), in place. Each vec4 is two complex numbers,
// of two transforms.

#include "interface/ocean.h"

vec4 pair_times_i(vec4 a) {
    return vec4(-a.y, a.x, -a.w, a.z);
}

vec4 pair_times(vec4 a, vec2 b) {
    return vec4(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x, a.z * b.x - a.w * b.y,
                a.z * b.y + a.w * b.x);
}

void transform_4(inout vec4 a, inout vec4 b, inout vec4 c, inout vec4 d) {
    vec4 s = a + c, t = a - c, u = b + d, v = pair_times_i(b - d);
    a = s + u;
    b = t + v;
    c = s - u;
    d = t - v;
}

const float ROOT_HALF = 0.70710678118654752;

void transform_8(inout vec4 v[8]) {
    transform_4(v[0], v[2], v[4], v[6]);
    transform_4(v[1], v[3], v[5], v[7]);
    vec4 odd[4] = vec4[4](v[1], pair_times(v[3], vec2(ROOT_HALF, ROOT_HALF)), pair_times_i(v[5]),
                          pair_times(v[7], vec2(-ROOT_HALF, ROOT_HALF)));
    vec4 even[4] = vec4[4](v[0], v[2], v[4], v[6]);
    for (int i = 0; i < 4; ++i) {
        v[i] = even[i] + odd[i];
        v[i + 4] = even[i] - odd[i];
    }
}

// Of the first `radix` numbers.
void transform(uint radix, inout vec4 v[8]) {
    if (radix == 8u) {
        transform_8(v);
    } else if (radix == 4u) {
        transform_4(v[0], v[1], v[2], v[3]);
    } else if (radix == 2u) {
        vec4 sum = v[0] + v[1];
        v[1] = v[0] - v[1];
        v[0] = sum;
    }
}

#endif
