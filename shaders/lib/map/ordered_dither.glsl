#ifndef LIB_ORDERED_DITHER_GLSL
#define LIB_ORDERED_DITHER_GLSL

#include "lib/number/hash.glsl"

// A threshold in (0, 1) for each pixel, fixed to the picture. Of the pixels of an aligned block of
// 2^k x 2^k, k <= 4, exactly one is in each of the 4^k equal parts of (0, 1): Bayer's order
// (Bayer 1973, An optimum method for two-level rendition of continuous-tone pictures). The four
// parts of each block change places at random (Owen 1995, Randomly permuted (t,m,s)-nets), so that
// no pattern in the picture is in step with the order.

const int DITHER_LEVELS = 4;

// `layer`: each number has its own order.
float ordered_dither(uvec2 pixel, uint layer) {
    uint index = 1u; // base 4, after a leading one that tells the levels apart
    for (int level = 0; level < DITHER_LEVELS; ++level) {
        uvec2 bits = pixel & 1u;
        pixel >>= 1u;
        uint order = hash(hash(hash(layer + index) + pixel.x) + pixel.y) & 3u;
        index = 4u * index + ((((bits.x ^ bits.y) << 1u) | bits.y) ^ order);
    }
    float parts = exp2(float(2 * DITHER_LEVELS));
    return (float(index) - parts + 0.5) / parts;
}

#endif
