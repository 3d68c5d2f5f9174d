#include "tests/passes/support/mask_reference.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "tests/passes/support/scene_builder.h"

/// Points to a texel's side.
enum { POINTS = 24, DISCS = 24 };

static double smooth_alpha(double u, double v) {
    return 0.5 + 0.25 * sin(6 * M_PI * u + 1) * cos(4 * M_PI * v) +
           0.25 * sin(10 * M_PI * v + 2 * M_PI * u);
}

/// The distance on the unit square, repeated.
static double wrapped(double a, double b) {
    double difference = fabs(a - b);
    return fmin(difference, 1 - difference);
}

static double disc_alpha(double u, double v, double texel) {
    random_sequence sequence = scenes_random_start(71);
    double alpha = 0;
    for (int i = 0; i < DISCS; i++) {
        double x = scenes_random_between(&sequence, 0, 1),
               y = scenes_random_between(&sequence, 0, 1),
               radius = scenes_random_between(&sequence, 0.05, 0.12);
        double inside = radius - hypot(wrapped(u, x), wrapped(v, y));
        alpha = fmax(alpha, fmin(fmax(inside / texel + 0.5, 0), 1));
    }
    return alpha;
}

lobe_image mask_image(mask_pattern pattern, uint32_t width, uint32_t height) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    float *texel = image.texels;
    for (uint32_t i = 0; i < width * height; i++, texel += 4) {
        uint32_t x = i % width, y = i / width;
        double u = (x + 0.5) / width, v = (y + 0.5) / height;
        double alpha = pattern == MASK_CHECKER  ? (x / 2 + y / 2) % 2
                       : pattern == MASK_SMOOTH ? smooth_alpha(u, v)
                                                : disc_alpha(u, v, 1.0 / width);
        texel[0] = alpha >= 0.25 ? 1 : 0;
        texel[1] = 0.5f;
        texel[2] = 1 - texel[0];
        texel[3] = (float)alpha;
    }
    return image;
}

static uint32_t wrapped_texel(int32_t texel, int32_t size, bool clamped) {
    if (clamped)
        return (uint32_t)(texel < 0 ? 0 : texel < size ? texel : size - 1);
    return (uint32_t)((texel + size) % size);
}

static const float *texel_at(const lobe_image *image, bool clamped, double x, double y) {
    uint32_t column = wrapped_texel((int32_t)x, (int32_t)image->width, clamped);
    uint32_t row = wrapped_texel((int32_t)y, (int32_t)image->height, clamped);
    return (const float *)image->texels + 4 * ((size_t)row * image->width + column);
}

/// RGBA at a place of the map, in texels.
static void colour_at(const lobe_image *image, mask_sampling sampling, double x, double y,
                      double colour[4]) {
    double left = sampling.nearest ? floor(x) : floor(x - 0.5),
           top = sampling.nearest ? floor(y) : floor(y - 0.5);
    double u = sampling.nearest ? 0 : x - 0.5 - left, v = sampling.nearest ? 0 : y - 0.5 - top;
    for (int i = 0; i < 4; i++)
        colour[i] = (1 - v) * ((1 - u) * (double)texel_at(image, sampling.clamped, left, top)[i] +
                               u * (double)texel_at(image, sampling.clamped, left + 1, top)[i]) +
                    v * ((1 - u) * (double)texel_at(image, sampling.clamped, left, top + 1)[i] +
                         u * (double)texel_at(image, sampling.clamped, left + 1, top + 1)[i]);
}

void mask_mean(const lobe_image *image, mask_sampling sampling, double cutoff,
               const double corner[2], const double extent[2], double mean[4]) {
    int columns = (int)ceil(extent[0] * POINTS), rows = (int)ceil(extent[1] * POINTS);
    memset(mean, 0, 4 * sizeof *mean);
    for (int i = 0; i < columns * rows; i++) {
        double colour[4];
        colour_at(image, sampling, corner[0] + extent[0] * (i % columns + 0.5) / columns,
                  corner[1] + extent[1] * (i / columns + 0.5) / rows, colour);
        if (colour[3] < cutoff)
            continue;
        colour[3] = 1;
        for (int channel = 0; channel < 4; channel++)
            mean[channel] += colour[channel] / (columns * rows);
    }
}
