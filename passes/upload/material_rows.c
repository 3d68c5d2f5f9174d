#include "passes/upload/material_rows.h"

#include <math.h>
#include <string.h>

#include "passes/upload/material_maps.h"

static const lobe_image *image_of(const device_material *material, uint32_t map) {
    return material->maps[map].use ? material->maps[map].texels : NULL;
}

bool passes_material_rows_are_readable(const device_material *material) {
    float texel[4];
    for (uint32_t map = MAP_NORMAL; map <= MAP_WIDTH; map++) {
        const lobe_image *image = image_of(material, map);
        if (image && !passes_image_texel(image, 0, 0, texel))
            return false;
    }
    return true;
}

material_rows *passes_material_rows_create(const lobe_allocator *allocator,
                                           const device_material *material) {
    const lobe_grid grid = passes_lobe_grid(material);
    enum { ARRAYS = 5 };
    material_rows *rows = lobe_allocate(
        allocator, 1, sizeof *rows + (size_t)ARRAYS * grid.width * sizeof *rows->data);
    if (!rows)
        return NULL;
    rows->normals = image_of(material, MAP_NORMAL);
    rows->widths = passes_widths_lie_apart(material) ? NULL : image_of(material, MAP_WIDTH);
    rows->width = grid.width;
    rows->height = grid.height;
    rows->encoding = material->maps[MAP_NORMAL].normals;
    rows->normal_scale = material->material->normal_scale;
    rows->factor_channel = material->material->model == LOBE_MATERIAL_MICROFACET ? 1 : 0;
    for (uint32_t i = 0; i < 3; i++)
        rows->normal[i] = rows->data + (size_t)i * grid.width;
    rows->factor = rows->data + (size_t)3 * grid.width;
    rows->texels = rows->data + (size_t)4 * grid.width;
    for (uint32_t x = 0; x < grid.width; x++) {
        rows->normal[2][x] = 1;
        rows->factor[x] = material->width_factor;
    }
    return rows;
}

// ---------------------------------------------------------------------------------------------
// One row. Loops without branches, which compilers vectorise.

static void decode_bytes(const unsigned char *texels, uint32_t stride, uint32_t count,
                         float *values) {
    for (uint32_t x = 0; x < count; x++)
        values[x] = (float)texels[(size_t)x * stride] * (1.0f / 255);
}

static void decode_words(const unsigned char *texels, uint32_t stride, uint32_t count,
                         float *values) {
    for (uint32_t x = 0; x < count; x++) {
        uint16_t word;
        memcpy(&word, texels + (size_t)x * stride, sizeof word);
        values[x] = (float)word * (1.0f / 65535);
    }
}

static void decode_signed_bytes(const unsigned char *texels, uint32_t stride, uint32_t count,
                                float *values) {
    for (uint32_t x = 0; x < count; x++)
        values[x] = fmaxf((float)(int8_t)texels[(size_t)x * stride] * (1.0f / 127), -1);
}

static void decode_signed_words(const unsigned char *texels, uint32_t stride, uint32_t count,
                                float *values) {
    for (uint32_t x = 0; x < count; x++) {
        int16_t word;
        memcpy(&word, texels + (size_t)x * stride, sizeof word);
        values[x] = fmaxf((float)word * (1.0f / 32767), -1);
    }
}

static bool has_sign(lobe_format format) {
    return format == LOBE_FORMAT_RG8_SNORM || format == LOBE_FORMAT_RGBA8_SNORM ||
           format == LOBE_FORMAT_RG16_SNORM || format == LOBE_FORMAT_RGBA16_SNORM;
}

static void decode_floats(const unsigned char *texels, uint32_t stride, uint32_t count,
                          float *values) {
    for (uint32_t x = 0; x < count; x++)
        memcpy(&values[x], texels + (size_t)x * stride, sizeof values[x]);
}

/// One channel of a row of an image, in a format that passes_image_texel reads.
static void decode(const lobe_image *image, uint32_t y, uint32_t channel, float *values) {
    const uint32_t stride = (uint32_t)lobe_format_size(image->format);
    const uint32_t channels = lobe_format_channels(image->format), size = stride / channels;
    const unsigned char *row =
        (const unsigned char *)image->texels + (size_t)y * image->width * stride + channel * size;
    if (channel >= channels)
        memset(values, 0, image->width * sizeof *values);
    else if (size == 1)
        (has_sign(image->format) ? decode_signed_bytes : decode_bytes)(row, stride, image->width,
                                                                       values);
    else if (size == 2)
        (has_sign(image->format) ? decode_signed_words : decode_words)(row, stride, image->width,
                                                                       values);
    else
        decode_floats(row, stride, image->width, values);
}

/// The same at the texels of the grid.
static void read_channel(material_rows *rows, const lobe_image *image, uint32_t y, uint32_t channel,
                         float *values) {
    const uint32_t row = (uint32_t)((uint64_t)y * image->height / rows->height);
    if (image->width == rows->width) {
        decode(image, row, channel, values);
        return;
    }
    decode(image, row, channel, rows->texels);
    for (uint32_t x = 0; x < rows->width; x++)
        values[x] = rows->texels[(uint64_t)x * image->width / rows->width];
}

/// As stored_normal in shaders/lib/map/normal_map.glsl.
static void reconstruct_z(material_rows *rows, float factor, float offset) {
    const float *restrict nx = rows->normal[0], *restrict ny = rows->normal[1];
    float *restrict nz = rows->normal[2];
    for (uint32_t i = 0; i < rows->width; i++) {
        float x = factor * nx[i] - offset, y = factor * ny[i] - offset;
        float z = sqrtf(fmaxf(0, 1 - x * x - y * y));
        nz[i] = (z + offset) / factor;
    }
}

static void normalise(material_rows *rows) {
    const float scale = rows->normal_scale;
    const bool is_signed = passes_normals_are_signed(rows->encoding);
    const float factor = is_signed ? 1 : 2, offset = is_signed ? 0 : 1;
    if (passes_normals_lack_z(rows->encoding))
        reconstruct_z(rows, factor, offset);
    float *restrict nx = rows->normal[0], *restrict ny = rows->normal[1],
                    *restrict nz = rows->normal[2];
    for (uint32_t i = 0; i < rows->width; i++) {
        float x = (factor * nx[i] - offset) * scale, y = (factor * ny[i] - offset) * scale,
              z = factor * nz[i] - offset;
        float square = x * x + y * y + z * z;
        // False for NaN, too.
        bool sound = square > 1e-12f && square < 1e30f;
        float inverse = 1 / sqrtf(sound ? square : 1);
        nx[i] = sound ? x * inverse : 0;
        ny[i] = sound ? y * inverse : 0;
        nz[i] = sound ? z * inverse : 1;
    }
}

void passes_material_row_read(material_rows *rows, uint32_t y) {
    for (uint32_t i = 0; rows->normals && i < 3; i++)
        read_channel(rows, rows->normals, y, i, rows->normal[i]);
    if (rows->normals)
        normalise(rows);
    if (rows->widths)
        read_channel(rows, rows->widths, y, rows->factor_channel, rows->factor);
}
