#include "scenes/material/image_channel.h"

#include <math.h>

#include "scenes/format/image_file.h"

double scenes_image_channel_value(const lobe_image *image, uint32_t column, uint32_t row,
                                  uint32_t channel) {
    const size_t index = ((size_t)row * image->width + column) * 4 + channel;
    if (image->format == LOBE_FORMAT_RGBA16_UNORM)
        return ((const uint16_t *)image->texels)[index] / 65535.0;
    return ((const uint8_t *)image->texels)[index] / 255.0;
}

static double read_texel(const image_channel *from, uint32_t column, uint32_t row) {
    return scenes_image_channel_value(from->image, column, row, from->channel);
}

// The two texels of a line of `extent` on either side of a position in texels, in [-0.5, extent -
// 0.5), and its distance from the first.
static double neighbours(double position, uint32_t extent, uint32_t *first, uint32_t *second) {
    double below = floor(position);
    *first = below < 0 ? extent - 1 : (uint32_t)below;
    *second = (*first + 1) % extent;
    return position - below;
}

// Samples at a point of the whole image, u and v in [0, 1).
static double interpolate(const image_channel *from, double u, double v) {
    uint32_t left, right, above, below;
    double x = neighbours(u * from->image->width - 0.5, from->image->width, &left, &right);
    double y = neighbours(v * from->image->height - 0.5, from->image->height, &above, &below);
    double upper = read_texel(from, left, above) * (1 - x) + read_texel(from, right, above) * x;
    double lower = read_texel(from, left, below) * (1 - x) + read_texel(from, right, below) * x;
    return upper * (1 - y) + lower * y;
}

static void fill_channel(const image_channel *from, uint32_t channel, lobe_image *packed) {
    uint8_t *texel = (uint8_t *)packed->texels + channel;
    bool constant = !from->image || !from->image->texels;
    for (uint32_t row = 0; row < packed->height; row++)
        for (uint32_t column = 0; column < packed->width; column++, texel += 4) {
            double value = constant ? from->value
                                    : interpolate(from, (column + 0.5) / packed->width,
                                                  (row + 0.5) / packed->height);
            value = from->inverted && !constant ? 1 - value : value;
            *texel = (uint8_t)(value * 255 + 0.5);
        }
}

lobe_result scenes_image_channel_pack(const image_channel channels[4], const char *name,
                                      const lobe_host *host, lobe_image *packed) {
    uint32_t width = 1, height = 1;
    *packed = (lobe_image){0};
    for (int i = 0; i < 4; i++)
        if (channels[i].image && channels[i].image->texels) {
            width = channels[i].image->width > width ? channels[i].image->width : width;
            height = channels[i].image->height > height ? channels[i].image->height : height;
        }
    if ((size_t)width * height > SCENE_IMAGE_MAXIMUM_TEXELS)
        return lobe_host_fail(
            host, LOBE_ERROR_LIMIT,
            "%s: packed together, the maps have %u x %u texels, more than lobe allows", name, width,
            height);
    lobe_result status = lobe_image_allocate(packed, LOBE_FORMAT_RGBA8_UNORM, width, height, host);
    for (uint32_t i = 0; !status && i < 4; i++)
        fill_channel(&channels[i], i, packed);
    return status;
}

bool scenes_image_channel_is_full(const lobe_image *image, uint32_t channel) {
    size_t count = (size_t)image->width * image->height * 4;
    for (size_t i = channel; i < count; i += 4)
        if (image->format == LOBE_FORMAT_RGBA16_UNORM
                ? ((const uint16_t *)image->texels)[i] != 0xffff
                : ((const uint8_t *)image->texels)[i] != 0xff)
            return false;
    return true;
}

void scenes_image_channel_invert(lobe_image *image, uint32_t channel) {
    size_t count = (size_t)image->width * image->height * 4;
    for (size_t i = channel; i < count; i += 4)
        if (image->format == LOBE_FORMAT_RGBA16_UNORM)
            ((uint16_t *)image->texels)[i] ^= 0xffff;
        else
            ((uint8_t *)image->texels)[i] ^= 0xff;
}
