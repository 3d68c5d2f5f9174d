#include "passes/upload/heights/height_normals.h"

#include <math.h>

#include "passes/upload/material_maps.h"

static double height_at(const lobe_image *image, uint32_t x, uint32_t y) {
    double height;
    return passes_height_texel(image, x, y, &height) ? height : 0;
}

/// The neighbour before (`forwards`: after) texel `i` of `size`.
static uint32_t neighbour(uint32_t i, uint32_t size, bool forwards, lobe_scene_wrap wrap) {
    if (forwards && i + 1 < size)
        return i + 1;
    if (!forwards && i > 0)
        return i - 1;
    const uint32_t other_end = forwards ? 0 : size - 1;
    return wrap == LOBE_SCENE_WRAP_REPEAT ? other_end : i; // mirrored, the neighbour is its like
}

/// Per texel, towards higher columns (or rows).
static double difference(const lobe_image *image, const lobe_texture_use *use, uint32_t x,
                         uint32_t y, bool across) {
    double heights[2];
    for (int i = 0; i < 2; i++)
        heights[i] = across ? height_at(image, neighbour(x, image->width, i == 1, use->wrap_u), y)
                            : height_at(image, x, neighbour(y, image->height, i == 1, use->wrap_v));
    return 0.5 * (heights[1] - heights[0]);
}

static int16_t quantised(double value) {
    return (int16_t)lround(32767 * value);
}

lobe_result passes_height_normals_make(const lobe_scene_image *heights, const lobe_texture_use *use,
                                       float height_scale, const lobe_host *host,
                                       lobe_image *normals) {
    const lobe_image *image = &heights->image;
    const lobe_result result =
        lobe_image_allocate(normals, LOBE_FORMAT_RG16_SNORM, image->width, image->height, host);
    if (result != LOBE_OK)
        return result;
    // A texel is 1 / width as wide, and as high, as the map is wide. Within a range in which
    // squares are.
    const double factor = fmax(fmin((double)height_scale * image->width, 1e9), -1e9);
    int16_t *texel = normals->texels;
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++, texel += 2) {
            const double across = factor * difference(image, use, x, y, true),
                         down = factor * difference(image, use, x, y, false);
            const double length = hypot(1, hypot(across, down));
            texel[0] = quantised(-across / length);
            texel[1] = quantised(down / length); // rows run against y
        }
    }
    return LOBE_OK;
}
