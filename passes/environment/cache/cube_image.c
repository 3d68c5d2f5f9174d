#include "passes/environment/cache/cube_image.h"

#include <stdbool.h>
#include <string.h>

#define FACES 6

/// Enough for any image of at most 65535 texels per side.
#define MAXIMUM_LEVELS 16

// ---------------------------------------------------------------------------------------------
// The cube in memory

static size_t face_texels(const cube_image *cube, uint32_t level) {
    size_t width = cube->width >> level;
    return width * width;
}

size_t passes_cube_image_texels(const cube_image *cube) {
    size_t count = 0;
    for (uint32_t level = 0; level < cube->levels; level++)
        count += FACES * face_texels(cube, level);
    return count;
}

float *passes_cube_image_face(const cube_image *cube, uint32_t level, uint32_t face) {
    size_t first = face * face_texels(cube, level);
    for (uint32_t finer = 0; finer < level; finer++)
        first += FACES * face_texels(cube, finer);
    return cube->texels + 4 * first;
}

lobe_result passes_cube_image_allocate(cube_image *cube, uint32_t width, const lobe_host *host) {
    *cube = (cube_image){.width = width};
    for (uint32_t extent = width; extent > 0; extent /= 2)
        ++cube->levels;
    cube->texels = lobe_allocate(lobe_host_allocator(host), 4 * passes_cube_image_texels(cube),
                                 sizeof *cube->texels);
    if (cube->texels)
        return LOBE_OK;
    *cube = (cube_image){0};
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY,
                          "environment: out of memory for a cube of %u texels per face", width);
}

void passes_cube_image_free(cube_image *cube) {
    lobe_release(cube->texels);
    *cube = (cube_image){0};
}

// ---------------------------------------------------------------------------------------------
// Orientation

/// Seen from inside, Vulkan's faces are mirrored and OpenEXR's are not: sides are flipped left to
/// right, top and bottom upside down. The flip is its own inverse.
static size_t flipped(uint32_t face, uint32_t width, uint32_t x, uint32_t y) {
    bool vertical = face == 2 || face == 3;
    uint32_t column = vertical ? x : width - 1 - x, row = vertical ? width - 1 - y : y;
    return (size_t)row * width + column;
}

static void flip_face(uint32_t face, uint32_t width, const float *source, float *target) {
    for (uint32_t y = 0; y < width; y++) {
        for (uint32_t x = 0; x < width; x++, target += 4)
            memcpy(target, source + 4 * flipped(face, width, x, y), 4 * sizeof *target);
    }
}

// ---------------------------------------------------------------------------------------------
// Writing

static void fill_column(const cube_image *cube, uint32_t level, lobe_image *image) {
    uint32_t width = cube->width >> level;
    for (uint32_t face = 0; face < FACES; face++)
        flip_face(face, width, passes_cube_image_face(cube, level, face),
                  (float *)image->texels + 4 * (size_t)face * width * width);
}

static void fill_with_mean(const cube_image *cube, lobe_image *image) {
    float *texels = image->texels;
    for (size_t i = 0; i < (size_t)4 * image->width * image->height; i++) {
        double sum = 0;
        for (uint32_t face = 0; face < FACES; face++)
            sum += (double)passes_cube_image_face(cube, cube->levels - 1, face)[i % 4];
        texels[i] = (float)(sum / FACES);
    }
}

static lobe_result make_levels(const cube_image *cube, const lobe_host *host,
                               lobe_image images[MAXIMUM_LEVELS], uint32_t *count) {
    uint32_t width = cube->width, height = FACES * cube->width;
    lobe_result result = LOBE_OK;
    while (result == LOBE_OK && height > 0) {
        lobe_image *image = &images[*count];
        result = lobe_image_allocate(image, LOBE_FORMAT_RGBA32_FLOAT, width > 0 ? width : 1, height,
                                     host);
        if (result == LOBE_OK && *count < cube->levels)
            fill_column(cube, *count, image);
        else if (result == LOBE_OK)
            fill_with_mean(cube, image);
        ++*count;
        width /= 2;
        height /= 2;
    }
    return result;
}

lobe_result passes_cube_image_write(const char *path, const cube_image *cube,
                                    const lobe_exr_attribute *attributes, size_t attribute_count,
                                    const lobe_host *host) {
    lobe_image images[MAXIMUM_LEVELS] = {0};
    uint32_t count = 0;
    lobe_result result = make_levels(cube, host, images, &count);
    const lobe_exr_layer layer = {.image = images, .depth = LOBE_EXR_FLOAT};
    if (result == LOBE_OK)
        result = lobe_exr_write(path,
                                &(lobe_exr_parameters){.layers = &layer,
                                                       .layer_count = 1,
                                                       .attributes = attributes,
                                                       .attribute_count = attribute_count,
                                                       .level_count = count,
                                                       .environment = LOBE_EXR_CUBE},
                                host);
    for (uint32_t level = 0; level < count; level++)
        lobe_image_free(&images[level]);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Reading

static bool is_cube(const lobe_exr_contents *contents) {
    const lobe_image *finest = &contents->levels[0];
    bool power_of_two = (finest->width & (finest->width - 1)) == 0;
    return contents->environment == LOBE_EXR_CUBE && power_of_two &&
           finest->height == FACES * finest->width && contents->level_count > 1;
}

lobe_result passes_cube_image_from(const char *path, const lobe_exr_contents *contents,
                                   const lobe_host *host, cube_image *cube) {
    *cube = (cube_image){0};
    if (!is_cube(contents))
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: not a cube with levels", path);
    lobe_result result = passes_cube_image_allocate(cube, contents->levels[0].width, host);
    for (uint32_t level = 0; result == LOBE_OK && level < cube->levels; level++) {
        uint32_t width = cube->width >> level;
        const float *column = contents->levels[level].texels;
        for (uint32_t face = 0; face < FACES; face++)
            flip_face(face, width, column + 4 * (size_t)face * width * width,
                      passes_cube_image_face(cube, level, face));
    }
    return result;
}
