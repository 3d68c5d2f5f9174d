#include "tests/passes/filters/wu/sample_reliefs.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <lobe/exr.h>

#include "scenes/builtin/random.h"
#include "scenes/format/image_file.h"
#include "tests/passes/support/scene_builder.h"

static float *height(const lobe_image *map, uint32_t x, uint32_t y) {
    return (float *)map->texels + 4 * ((size_t)(y % map->height) * map->width + x % map->width);
}

double sample_relief_slope(const lobe_image *map) {
    double sum = 0;
    for (uint32_t i = 0; i < map->width * map->height; i++) {
        const uint32_t x = i % map->width, y = i / map->width;
        const double at = (double)*height(map, x, y);
        sum += pow((double)*height(map, x + 1, y) - at, 2) +
               pow((double)*height(map, x, y + 1) - at, 2);
    }
    return sqrt(sum / (map->width * map->height));
}

void sample_relief_scale(const lobe_image *map, double slope) {
    const double scale = slope / sample_relief_slope(map);
    for (uint32_t i = 0; i < map->width * map->height; i++) {
        float *texel = (float *)map->texels + 4 * (size_t)i;
        *texel = (float)(scale * (double)*texel);
    }
}

/// Of a thread that runs along `along`, over two others and under two; `across`: of its middle.
static double thread_height(double across, double along, bool over) {
    const double rise = 2.2 * cos(2 * M_PI * along);
    return 6.5 * sqrt(fmax(1 - across * across, 0)) + (over ? rise : -rise);
}

lobe_image sample_relief_twill(void) {
    enum { THREAD = 16 };
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, SAMPLE_EXTENT, SAMPLE_EXTENT);
    for (uint32_t i = 0; i < SAMPLE_EXTENT * SAMPLE_EXTENT; i++) {
        const double x = (i % SAMPLE_EXTENT + 0.5) / THREAD, y = (i / SAMPLE_EXTENT + 0.5) / THREAD;
        // Threads along y rise where (column + row) mod 4 < 2.
        const double column = floor(x), row = floor(y);
        const double upright = thread_height(2 * (x - column) - 1, (y + column - 1) / 4, true),
                     level = thread_height(2 * (y - row) - 1, (x + row - 1) / 4, false);
        *height(&map, i % SAMPLE_EXTENT, i / SAMPLE_EXTENT) = (float)fmax(upright, level);
    }
    return map;
}

lobe_image sample_relief_bumps(uint64_t seed) {
    enum { BUMPS = 400 };
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, SAMPLE_EXTENT, SAMPLE_EXTENT);
    random_sequence numbers = scenes_random_start(seed);
    for (int k = 0; k < BUMPS; k++) {
        const int x = (int)scenes_random_between(&numbers, 0, SAMPLE_EXTENT),
                  y = (int)scenes_random_between(&numbers, 0, SAMPLE_EXTENT);
        const double radius = scenes_random_between(&numbers, 4.5, 9.5);
        for (int i = -10; i <= 10; i++)
            for (int j = -10; j <= 10; j++) {
                float *at = height(&map, (uint32_t)(x + i + SAMPLE_EXTENT),
                                   (uint32_t)(y + j + SAMPLE_EXTENT));
                *at = fmaxf(*at, (float)sqrt(fmax(radius * radius - i * i - j * j, 0)));
            }
    }
    return map;
}

lobe_image sample_relief_noise(uint32_t extent, double wavelength, uint64_t seed) {
    enum { WAVES = 300 };
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, extent, extent);
    random_sequence numbers = scenes_random_start(seed);
    for (int k = 0; k < WAVES; k++) {
        // Whole numbers of waves, about Gaussian.
        double count[2];
        for (int i = 0; i < 2; i++) {
            double sum = 0;
            for (int j = 0; j < 4; j++)
                sum += scenes_random_between(&numbers, -1, 1);
            count[i] = round(0.75 * sum * extent / wavelength);
        }
        const double phase = scenes_random_between(&numbers, 0, 2 * M_PI);
        for (uint32_t i = 0; i < extent * extent; i++)
            ((float *)map.texels)[4 * (size_t)i] += (float)sin(
                2 * M_PI * (count[0] * (i % extent) + count[1] * (i / extent)) / extent + phase);
    }
    sample_relief_scale(&map, 1);
    return map;
}

static double red(const lobe_image *file, size_t texel) {
    return file->format == LOBE_FORMAT_RGBA32_FLOAT
               ? (double)((const float *)file->texels)[4 * texel]
               : ((const uint8_t *)file->texels)[4 * texel];
}

lobe_image sample_relief_load(const char *path, const lobe_host *host) {
    lobe_image file, map = map_image(LOBE_FORMAT_RGBA32_FLOAT, SAMPLE_EXTENT, SAMPLE_EXTENT);
    const char *end = strrchr(path, '.');
    assert_int_equal(end && strcmp(end, ".exr") == 0
                         ? lobe_exr_read(path, NULL, host, &file)
                         : scenes_image_load(path, SCENE_IMAGE_DATA, host, &file),
                     LOBE_OK);
    assert_true(file.format == LOBE_FORMAT_RGBA32_FLOAT || file.format == LOBE_FORMAT_RGBA8_UNORM);
    const uint32_t part = file.width / SAMPLE_EXTENT;
    assert_true(part > 0 && file.height >= part * SAMPLE_EXTENT);
    for (uint32_t i = 0; i < SAMPLE_EXTENT * SAMPLE_EXTENT; i++) {
        double sum = 0;
        for (uint32_t k = 0; k < part * part; k++)
            sum += red(&file, (size_t)(i / SAMPLE_EXTENT * part + k / part) * file.width +
                                  i % SAMPLE_EXTENT * part + k % part);
        *height(&map, i % SAMPLE_EXTENT, i / SAMPLE_EXTENT) = (float)(sum / (part * part));
    }
    lobe_image_free(&file);
    sample_relief_scale(&map, 1);
    return map;
}

double sample_relief_normalise(lobe_image *map) {
    float *texels = map->texels, low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < map->width * map->height; i++) {
        low = fminf(low, texels[4 * i]);
        high = fmaxf(high, texels[4 * i]);
    }
    for (uint32_t i = 0; i < map->width * map->height; i++)
        texels[4 * i] = (texels[4 * i] - low) / (high - low);
    return (double)(high - low);
}
