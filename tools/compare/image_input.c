#include "tools/compare/image_input.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <lobe/colour.h>
#include <lobe/exr.h>
#include <lobe/png.h>

#include "scenes/format/exr_file.h"

/// Also false if the file cannot be read: then reading it as OpenEXR reports why.
static bool is_png(const char *path) {
    static const uint8_t signature[4] = {0x89, 'P', 'N', 'G'};
    uint8_t start[4] = {0};
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return false;
    size_t count = fread(start, 1, sizeof start, file);
    fclose(file);
    return count == sizeof start && memcmp(start, signature, sizeof start) == 0;
}

static float decode(const lobe_image *encoded, size_t channel) {
    bool wide = encoded->format == LOBE_FORMAT_RGBA16_UNORM;
    float value = wide ? (float)((const uint16_t *)encoded->texels)[channel] / 65535.0f
                       : (float)((const uint8_t *)encoded->texels)[channel] / 255.0f;
    return channel % 4 == 3 ? value : lobe_srgb_decode(value);
}

static lobe_result read_png(const char *path, const lobe_host *host, lobe_image *image) {
    lobe_image encoded;
    lobe_result result = lobe_png_read(path, host, &encoded);
    if (result != LOBE_OK)
        return result;
    result =
        lobe_image_allocate(image, LOBE_FORMAT_RGBA32_FLOAT, encoded.width, encoded.height, host);
    if (result == LOBE_OK) {
        size_t count = (size_t)4 * encoded.width * encoded.height;
        float *texels = image->texels;
        for (size_t channel = 0; channel < count; channel++)
            texels[channel] = decode(&encoded, channel);
    }
    lobe_image_free(&encoded);
    return result;
}

static lobe_result read_exr(const char *path, const lobe_host *host, lobe_image *image) {
    lobe_exr_contents contents;
    *image = (lobe_image){0};
    lobe_result result = lobe_exr_read_contents(path, NULL, host, &contents);
    if (result == LOBE_OK)
        scenes_exr_take_colours(&contents, path, host, image);
    return result;
}

lobe_result image_input_read(const char *path, const lobe_host *host, image_input *input) {
    *input = (image_input){.high_dynamic_range = !is_png(path)};
    return input->high_dynamic_range ? read_exr(path, host, &input->image)
                                     : read_png(path, host, &input->image);
}
