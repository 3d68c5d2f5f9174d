#include <lobe/colour.h>

#include <float.h>
#include <math.h>

/// NaN becomes 0: fmaxf returns its other argument.
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
    if (!rgb)
        return 0;
    return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

// ---------------------------------------------------------------------------------------------
// Pictures for displays

static uint8_t to_byte(float value) {
    return (uint8_t)(fminf(fmaxf(value, 0.0f), 1.0f) * 255.0f + 0.5f);
}

static float shoulder(float maximum) {
    return maximum <= 0.5f ? maximum : 1.0f - 0.25f / maximum;
}

static void encode_texel(const float *linear, const lobe_display_parameters *parameters, float gain,
                         uint8_t *texel) {
    float alpha = parameters->keep_alpha ? fminf(fmaxf(linear[3], 0.0f), 1.0f) : 1.0f;
    float colour[3];
    for (int channel = 0; channel < 3; channel++)
        colour[channel] = fminf(fmaxf(linear[channel] * gain / alpha, 0.0f), FLT_MAX);
    float maximum = fmaxf(colour[0], fmaxf(colour[1], colour[2]));
    bool compress = parameters->tone_map == LOBE_TONE_MAP_SHOULDER && maximum > 0.0f;
    for (int channel = 0; channel < 3; channel++) {
        // Divide first: for huge radiance, the scale alone would be subnormal.
        float value = compress ? colour[channel] / maximum * shoulder(maximum) : colour[channel];
        texel[channel] = to_byte(lobe_srgb_encode(value));
    }
    texel[3] = to_byte(alpha);
}

lobe_result lobe_display_encode(const lobe_image *linear, const lobe_display_parameters *parameters,
                                const lobe_host *host, lobe_image *picture) {
    if (picture)
        *picture = (lobe_image){0};
    if (!linear || !linear->texels || !picture)
        return lobe_host_fail(
            host, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_display_encode: the image, its texels and picture must not be NULL");
    static const lobe_display_parameters defaults = {0};
    parameters = parameters != NULL ? parameters : &defaults;
    if (linear->format != LOBE_FORMAT_RGBA32_FLOAT)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "picture: made from RGBA32_FLOAT images, not from %s",
                              lobe_format_name(linear->format));
    lobe_result result =
        lobe_image_allocate(picture, LOBE_FORMAT_RGBA8_SRGB, linear->width, linear->height, host);
    if (result != LOBE_OK)
        return result;
    const float *source = linear->texels;
    uint8_t *target = picture->texels;
    size_t count = (size_t)linear->width * linear->height;
    float gain = exp2f(parameters->exposure);
    for (size_t index = 0; index < count; index++)
        encode_texel(source + 4 * index, parameters, gain, target + 4 * index);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Heat map

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
    if (!srgb)
        return;
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
