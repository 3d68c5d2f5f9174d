#include "scenes/format/exr_file.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include <lobe/colour.h>

bool scenes_exr_recognise(const void *bytes, size_t size) {
    static const uint8_t exr[4] = {0x76, 0x2f, 0x31, 0x01};
    return size >= sizeof exr && memcmp(bytes, exr, sizeof exr) == 0;
}

static void take_level(lobe_exr_contents *contents, lobe_image *image) {
    *image = contents->levels[0];
    contents->levels[0] = (lobe_image){0};
    lobe_exr_contents_free(contents);
}

void scenes_exr_take_colours(lobe_exr_contents *contents, const char *name, const lobe_host *host,
                             lobe_image *image) {
    if (!lobe_image_to_rec709(&contents->levels[0], contents->chromaticities))
        lobe_host_log(host, LOBE_LOG_WARNING,
                      "%s: its chromaticities span no colours; taken as those of Rec. 709", name);
    take_level(contents, image);
}

/// `colour`: of the primaries of Rec. 709.
static lobe_result decode(const void *bytes, size_t size, const char *name, bool colour,
                          const lobe_host *host, lobe_image *image, lobe_exr_environment *said) {
    lobe_exr_contents contents;
    *image = (lobe_image){0};
    lobe_result result = lobe_exr_decode_contents(name, bytes, size, NULL, host, &contents);
    if (result != LOBE_OK)
        return result;
    if (said)
        *said = contents.environment;
    if (colour)
        scenes_exr_take_colours(&contents, name, host, image);
    else
        take_level(&contents, image);
    return LOBE_OK;
}

lobe_result scenes_exr_decode(const void *bytes, size_t size, const char *name,
                              const lobe_host *host, lobe_image *image,
                              lobe_exr_environment *said) {
    return decode(bytes, size, name, true, host, image, said);
}

// ---------------------------------------------------------------------------------------------
// Maps

static bool is_within(const float texel[4]) {
    for (int channel = 0; channel < 4; channel++)
        if (!(texel[channel] >= 0 && texel[channel] <= 1))
            return false;
    return true;
}

static void encode_texel(const float texel[4], size_t index, lobe_image *map) {
    for (int channel = 0; channel < 4; channel++) {
        const float value = fminf(fmaxf(texel[channel], 0), 1); // NaN becomes 0
        if (map->format == LOBE_FORMAT_RGBA16_UNORM)
            ((uint16_t *)map->texels)[4 * index + channel] = (uint16_t)(value * 65535 + 0.5f);
        else
            ((uint8_t *)map->texels)[4 * index + channel] =
                (uint8_t)((channel < 3 ? lobe_srgb_encode(value) : value) * 255 + 0.5f);
    }
}

lobe_result scenes_exr_decode_map(const void *bytes, size_t size, const char *name,
                                  lobe_format format, const lobe_host *host, lobe_image *image) {
    lobe_image linear;
    *image = (lobe_image){0};
    lobe_result result =
        decode(bytes, size, name, format == LOBE_FORMAT_RGBA8_SRGB, host, &linear, NULL);
    result =
        result ? result : lobe_image_allocate(image, format, linear.width, linear.height, host);
    const size_t count = result ? 0 : (size_t)linear.width * linear.height;
    size_t outside = 0;
    for (size_t i = 0; i < count; i++) {
        const float *texel = (const float *)linear.texels + 4 * i;
        outside += !is_within(texel);
        encode_texel(texel, i, image);
    }
    if (outside > 0)
        lobe_host_log(host, LOBE_LOG_WARNING, "%s: %zu of %zu texels are outside [0, 1]; clamped",
                      name, outside, count);
    lobe_image_free(&linear);
    return result;
}
