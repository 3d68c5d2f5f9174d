#include <lobe/colour.h>

#include <float.h>
#include <math.h>

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
        // The quotient first: the scale alone would be a subnormal number for huge radiance.
        float value = compress ? colour[channel] / maximum * shoulder(maximum) : colour[channel];
        texel[channel] = to_byte(lobe_srgb_encode(value));
    }
    texel[3] = to_byte(alpha);
}

lobe_result lobe_display_encode(const lobe_image *linear, const lobe_display_parameters *parameters,
                                const lobe_host *host, lobe_image *picture) {
    static const lobe_display_parameters defaults = {0};
    parameters = parameters != NULL ? parameters : &defaults;
    *picture = (lobe_image){0};
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
