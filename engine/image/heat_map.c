#include <lobe/colour.h>

#include <math.h>

// Björn Ottosson, 2020, "A perceptual color space for image processing": Oklab to linear sRGB.
static void oklab_to_linear(const float lab[3], float rgb[3]) {
    float l = lab[0] + 0.3963377774f * lab[1] + 0.2158037573f * lab[2];
    float m = lab[0] - 0.1055613458f * lab[1] - 0.0638541728f * lab[2];
    float s = lab[0] - 0.0894841775f * lab[1] - 1.2914855480f * lab[2];
    l = l * l * l;
    m = m * m * m;
    s = s * s * s;
    rgb[0] = 4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s;
    rgb[1] = -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s;
    rgb[2] = -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s;
}

void lobe_heat_colour(float value, uint8_t srgb[3]) {
    const float pi = 3.14159265f;
    float t = fminf(fmaxf(value, 0.0f), 1.0f);
    // Lightness rises evenly, the hue turns by half a circle, chroma swells in the middle. The
    // constants keep the whole path inside the sRGB gamut with steps of equal length (within 4 %).
    float lightness = 0.15f + 0.82f * t;
    float hue = (285.0f + 180.0f * t) * pi / 180.0f;
    float chroma = 0.17f * powf(sinf(pi * (t + 0.10f) / 1.22f), 0.8f);
    float rgb[3];
    oklab_to_linear((float[3]){lightness, chroma * cosf(hue), chroma * sinf(hue)}, rgb);
    for (int channel = 0; channel < 3; channel++)
        srgb[channel] =
            isnan(value) ? 0 : (uint8_t)(lobe_srgb_encode(rgb[channel]) * 255.0f + 0.5f);
}
