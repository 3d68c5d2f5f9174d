#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/displacement/transfer_basis.glsl"

// Functions 0 to 3: four polynomials each of the direction a; 4 to 7: their integrals over an
// azimuth: a: slope, along, towards; b.x: up; b.y: width.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    float y[16];
    if (FUNCTION < 4u) {
        transfer_polynomials(a.xyz, y);
    } else {
        for (int k = 0; k < 16; ++k)
            y[k] = 0.0;
        add_polynomials_of_azimuth(a.x, a.yz, a.w, b.x, b.y, y);
    }
    uint first = 4u * (FUNCTION % 4u);
    return vec4(y[first], y[first + 1u], y[first + 2u], y[first + 3u]);
}
