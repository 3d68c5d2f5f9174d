#include "passes/upload/image_texel.h"

#include <string.h>

static float channel(const lobe_image *image, const unsigned char *texel, uint32_t index) {
    uint16_t word;
    float number;
    switch (image->format) {
    case LOBE_FORMAT_R8_UNORM:
    case LOBE_FORMAT_RG8_UNORM:
    case LOBE_FORMAT_RGBA8_UNORM:
        return (float)texel[index] / 255.0f;
    case LOBE_FORMAT_RGBA16_UNORM:
        memcpy(&word, texel + 2 * index, sizeof word);
        return (float)word / 65535.0f;
    default:
        memcpy(&number, texel + 4 * index, sizeof number);
        return number;
    }
}

static bool is_readable(lobe_format format) {
    switch (format) {
    case LOBE_FORMAT_R8_UNORM:
    case LOBE_FORMAT_RG8_UNORM:
    case LOBE_FORMAT_RGBA8_UNORM:
    case LOBE_FORMAT_RGBA16_UNORM:
    case LOBE_FORMAT_R32_FLOAT:
    case LOBE_FORMAT_RG32_FLOAT:
    case LOBE_FORMAT_RGBA32_FLOAT:
        return true;
    default:
        return false;
    }
}

bool passes_image_texel(const lobe_image *image, uint32_t x, uint32_t y, float value[4]) {
    if (!is_readable(image->format))
        return false;
    const unsigned char *texel = (const unsigned char *)image->texels +
                                 ((size_t)y * image->width + x) * lobe_format_size(image->format);
    for (uint32_t i = 0; i < 4; ++i)
        value[i] = i < lobe_format_channels(image->format) ? channel(image, texel, i)
                                                           : (i == 3 ? 1.0f : 0.0f);
    return true;
}
