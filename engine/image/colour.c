#include <lobe/colour.h>

#include <math.h>

/// fmaxf returns the number where the other is NaN.
static float clamp01(float value) {
    return fminf(fmaxf(value, 0.0f), 1.0f);
}

// IEC 61966-2-1:1999, the sRGB transfer function.
float lobe_srgb_encode(float linear) {
    float value = clamp01(linear);
    return value <= 0.0031308f ? 12.92f * value : 1.055f * powf(value, 1.0f / 2.4f) - 0.055f;
}

float lobe_srgb_decode(float encoded) {
    float value = clamp01(encoded);
    return value <= 0.04045f ? value / 12.92f : powf((value + 0.055f) / 1.055f, 2.4f);
}

// ITU-R BT.709, item 3.2.
float lobe_luminance(const float rgb[3]) {
    return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}
