#include "scenes/environment/halve.h"

#include <math.h>
#include <string.h>

#include "scenes/environment/direction.h"

// One axis: the extent of a face before and after halving.
typedef struct halving {
    uint32_t before, after;
} halving;

static halving halve(uint32_t extent) {
    return (halving){extent, extent > 1 ? extent / 2 : 1};
}

// The part of the original image that texel `i` covers: two texels of its face, or up to three,
// some in part. It ends exactly at the edges of a face.
static void covered(const halving *axis, uint32_t i, double range[2]) {
    const uint32_t face = i / axis->after, place = i % axis->after;
    const double first = (double)face * axis->before;
    range[0] = first + (double)place * axis->before / axis->after;
    range[1] = first + (double)(place + 1) * axis->before / axis->after;
}

// The part of one row that a new texel covers.
typedef struct strip {
    double top, bottom;
    double angle; // of one texel in latitude and longitude, between top and bottom
} strip;

typedef struct reduction {
    const lobe_environment *environment;
    halving columns, rows;
    strip strips[3]; // that the row of texels being made covers
    int strip_count;
} reduction;

static double solid_angle(const reduction *work, double left, const strip *strip, double right) {
    const lobe_environment *environment = work->environment;
    if (environment->layout == LOBE_ENVIRONMENT_LATITUDE_LONGITUDE)
        return (right - left) * strip->angle;
    return scenes_environment_solid_angle(environment->layout, environment->image.width,
                                          environment->image.height, left, strip->top, right,
                                          strip->bottom);
}

static void cut_strips(reduction *work, double top, double bottom) {
    const lobe_environment *environment = work->environment;
    for (work->strip_count = 0; top < bottom && work->strip_count < 3; work->strip_count++) {
        strip *strip = &work->strips[work->strip_count];
        strip->top = top;
        strip->bottom = top = fmin(floor(top) + 1, bottom);
        strip->angle = scenes_environment_solid_angle(
            LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, environment->image.width,
            environment->image.height, 0, strip->top, 1, strip->bottom);
    }
}

// The mean over the strips between two columns.
static void mean_texel(const reduction *work, double from, double to, float out[4]) {
    const lobe_image *image = &work->environment->image;
    double sum[3] = {0}, weights = 0;
    for (int k = 0; k < work->strip_count; k++) {
        const strip *strip = &work->strips[k];
        const float *row = (const float *)image->texels + 4 * (size_t)strip->top * image->width;
        for (double left = from; left < to; left = floor(left) + 1) {
            const double weight = solid_angle(work, left, strip, fmin(floor(left) + 1, to));
            for (int i = 0; i < 3; i++)
                sum[i] += weight * row[4 * (size_t)left + i];
            weights += weight;
        }
    }
    for (int i = 0; i < 3; i++)
        out[i] = weights > 0 ? (float)(sum[i] / weights) : 0;
    out[3] = 1;
}

bool scenes_environment_can_be_halved(const lobe_environment *environment) {
    uint32_t grid[2];
    scenes_environment_grid(environment->layout, grid);
    return environment->image.width > grid[0] || environment->image.height > grid[1];
}

// In place: in memory, no new texel lies behind the first of those that it is computed from.
void scenes_environment_halve(lobe_environment *environment) {
    lobe_image *image = &environment->image;
    uint32_t grid[2];
    scenes_environment_grid(environment->layout, grid);
    reduction work = {.environment = environment,
                      .columns = halve(image->width / grid[0]),
                      .rows = halve(image->height / grid[1])};
    float *out = image->texels;
    for (uint32_t y = 0; y < grid[1] * work.rows.after; y++) {
        double range[2];
        covered(&work.rows, y, range);
        cut_strips(&work, range[0], range[1]);
        for (uint32_t x = 0; x < grid[0] * work.columns.after; x++, out += 4) {
            float mean[4];
            covered(&work.columns, x, range);
            mean_texel(&work, range[0], range[1], mean);
            memcpy(out, mean, sizeof mean);
        }
    }
    image->width = grid[0] * work.columns.after;
    image->height = grid[1] * work.rows.after;
    // Give back the rest of the memory if possible; if not, keeping it does no harm.
    void *smaller = lobe_reallocate(NULL, image->texels, (size_t)image->width * image->height,
                                    4 * sizeof(float));
    image->texels = smaller ? smaller : image->texels;
}
