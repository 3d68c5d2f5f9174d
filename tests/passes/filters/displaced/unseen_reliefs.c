#include "tests/passes/filters/displaced/unseen_reliefs.h"

#include <math.h>
#include <stdlib.h>

#include "scenes/builtin/random.h"
#include "tests/passes/filters/wu/sample_reliefs.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = UNSEEN_EXTENT };

/// A relief that is being made.
typedef struct making {
    lobe_image map;
    random_sequence numbers;
} making;

static making begin(uint64_t seed) {
    return (making){map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT), scenes_random_start(seed)};
}

static double between(making *relief, double low, double high) {
    return scenes_random_between(&relief->numbers, low, high);
}

/// Of repeated parts, texels: 16 or 32.
static int part_size(making *relief) {
    return between(relief, 0, 1) < 0.5 ? 16 : 32;
}

static float *height(making *relief, int x, int y) {
    const int column = (x + EXTENT) % EXTENT, row = (y + EXTENT) % EXTENT;
    return (float *)relief->map.texels + (size_t)4 * (size_t)(row * EXTENT + column);
}

static void raise_to(making *relief, int x, int y, double to) {
    *height(relief, x, y) = fmaxf(*height(relief, x, y), (float)to);
}

static void lower_to(making *relief, int x, int y, double to) {
    *height(relief, x, y) = fminf(*height(relief, x, y), (float)to);
}

/// With slopes of an rms that is drawn as well.
static lobe_image end(making *relief, double least_slope, double most_slope) {
    sample_relief_scale(&relief->map, between(relief, least_slope, most_slope));
    return relief->map;
}

/// Adds noise of waves of so many texels, with slopes of this rms.
static void add_noise(making *relief, double wavelength, double slope) {
    lobe_image noise =
        sample_relief_noise(EXTENT, wavelength, scenes_random_bits(&relief->numbers));
    for (size_t i = 0; i < (size_t)4 * EXTENT * EXTENT; i += 4)
        ((float *)relief->map.texels)[i] += (float)slope * ((float *)noise.texels)[i];
    lobe_image_free(&noise);
}

static lobe_image noise(uint64_t seed) {
    making relief = begin(seed);
    add_noise(&relief, between(&relief, 6, 30), 1);
    return end(&relief, 0.3, 1.2);
}

/// Coarse and fine, as of stone.
static lobe_image octaves(uint64_t seed) {
    making relief = begin(seed);
    for (double wavelength = 64; wavelength >= 4; wavelength /= 2)
        add_noise(&relief, wavelength, 1);
    return end(&relief, 0.4, 1.4);
}

/// Bands over and under each other.
static lobe_image basket(uint64_t seed) {
    making relief = begin(seed);
    const int band = part_size(&relief);
    const double rise = between(&relief, 0.4, 1);
    for (int i = 0; i < EXTENT * EXTENT; i++) {
        const int x = i % EXTENT, y = i / EXTENT, lies = (x / (2 * band) + y / (2 * band)) % 2;
        const double across = (lies ? x : y) % band, along = (lies ? y : x) % (2 * band);
        *height(&relief, x, y) = (float)(sqrt(fmax(1 - pow(2 * across / band - 1, 2), 0)) +
                                         rise * sin(M_PI * along / (2 * band)));
    }
    return end(&relief, 0.5, 1.3);
}

/// Tilted discs that overlap, as of fish or roofs.
static lobe_image scales(uint64_t seed) {
    making relief = begin(seed);
    const int size = part_size(&relief);
    const double radius = between(&relief, 0.55, 0.65) * size, tilt = between(&relief, 0.4, 0.7);
    for (int i = 0; i < EXTENT * EXTENT; i++)
        *height(&relief, i % EXTENT, i / EXTENT) = -0.4F;
    for (int row = 0; row < 2 * EXTENT / size; row++)
        for (int column = 0; column < EXTENT / size; column++)
            for (int i = -size; i <= size; i++)
                for (int j = -size; j <= size; j++) {
                    const double part = (i * i + j * j) / (radius * radius);
                    if (part < 1)
                        raise_to(&relief, column * size + row % 2 * size / 2 + i,
                                 row * size / 2 + j, tilt * j / size + 0.12 * (1 - part));
                }
    return end(&relief, 0.4, 1);
}

/// Long gentle slopes and short steep ones.
static lobe_image dunes(uint64_t seed) {
    making relief = begin(seed);
    add_noise(&relief, between(&relief, 40, 64), 0.25);
    const int count = EXTENT / part_size(&relief);
    const double crest = between(&relief, 0.6, 0.8);
    for (int i = 0; i < EXTENT * EXTENT; i++) {
        float *at = height(&relief, i % EXTENT, i / EXTENT);
        const double moved = (i % EXTENT + (double)*at) * count / EXTENT,
                     part = moved - floor(moved);
        *at = (float)(part < crest ? part / crest : (1 - part) / (1 - crest));
    }
    return end(&relief, 0.4, 1);
}

/// Level tops with rough grain, and grooves between.
static lobe_image bricks(uint64_t seed) {
    making relief = begin(seed);
    const int width = part_size(&relief);
    const double bevel = between(&relief, 2, 4), depth = between(&relief, 2, 6);
    add_noise(&relief, 5, between(&relief, 0.2, 0.5));
    for (int i = 0; i < EXTENT * EXTENT; i++) {
        const int row = i / EXTENT / (width / 2);
        const double x = (i % EXTENT + row % 2 * width / 2) % width, y = i / EXTENT % (width / 2),
                     edge = fmin(fmin(x, width - 1 - x), fmin(y, width / 2.0 - 1 - y));
        *height(&relief, i % EXTENT, i / EXTENT) += (float)(depth * fmin(edge / bevel, 1));
    }
    return end(&relief, 0.6, 1.6);
}

/// Straight scratches in all directions.
static lobe_image scratches(uint64_t seed) {
    making relief = begin(seed);
    const int count = (int)between(&relief, 30, 90);
    for (int k = 0; k < count; k++) {
        // Those of which the map holds whole numbers, so that it repeats.
        int step[2] = {(int)floor(between(&relief, -4, 5)), (int)floor(between(&relief, -4, 5))};
        if (step[0] == 0 && step[1] == 0)
            step[0] = 1;
        const double at = between(&relief, 0, EXTENT), depth = between(&relief, 1.5, 4);
        for (int i = 0; i < EXTENT * EXTENT; i++) {
            const double along = i % EXTENT * step[0] + i / EXTENT * step[1] + at;
            const double apart = fabs(remainder(along, EXTENT)) / hypot(step[0], step[1]);
            lower_to(&relief, i % EXTENT, i / EXTENT, fmin(apart - depth, 0));
        }
    }
    return end(&relief, 0.3, 0.8);
}

static lobe_image pyramids(uint64_t seed) {
    making relief = begin(seed);
    const int size = part_size(&relief);
    for (int i = 0; i < EXTENT * EXTENT; i++) {
        const int x = i % EXTENT % size - size / 2, y = i / EXTENT % size - size / 2;
        *height(&relief, i % EXTENT, i / EXTENT) = -(float)fmax(abs(x), abs(y));
    }
    return end(&relief, 0.7, 1.6);
}

/// Spherical, in level ground.
static lobe_image pits(uint64_t seed) {
    making relief = begin(seed);
    const int size = part_size(&relief);
    const double radius = between(&relief, 0.3, 0.48) * size;
    for (int row = 0; row < 2 * EXTENT / size; row++)
        for (int column = 0; column < EXTENT / size; column++)
            for (int i = -size / 2; i <= size / 2; i++)
                for (int j = -size / 2; j <= size / 2; j++)
                    lower_to(&relief, column * size + row % 2 * size / 2 + i, row * size / 2 + j,
                             -sqrt(fmax(1 - (i * i + j * j) / (radius * radius), 0)));
    return end(&relief, 0.6, 1.4);
}

/// Domes of stone on level ground.
static lobe_image domes(uint64_t seed) {
    making relief = begin(seed);
    const int size = part_size(&relief);
    for (int row = 0; row < EXTENT / size; row++)
        for (int column = 0; column < EXTENT / size; column++) {
            const double radius = between(&relief, 0.35, 0.55) * size;
            for (int i = -size; i <= size; i++)
                for (int j = -size; j <= size; j++)
                    raise_to(&relief, column * size + row % 2 * size / 2 + i, row * size + j,
                             sqrt(fmax(radius * radius - i * i - j * j, 0)));
        }
    return end(&relief, 0.5, 1.3);
}

/// Cones on level ground.
static lobe_image spikes(uint64_t seed) {
    making relief = begin(seed);
    const int size = part_size(&relief);
    const double radius = between(&relief, 0.25, 0.5) * size;
    for (int i = 0; i < EXTENT * EXTENT; i++) {
        const int x = i % EXTENT % size - size / 2, y = i / EXTENT % size - size / 2;
        *height(&relief, i % EXTENT, i / EXTENT) = (float)fmax(radius - hypot(x, y), 0);
    }
    return end(&relief, 0.8, 1.6);
}

static lobe_image grooves(uint64_t seed) {
    making relief = begin(seed);
    const int size = part_size(&relief);
    for (int i = 0; i < EXTENT * EXTENT; i++)
        *height(&relief, i % EXTENT, i / EXTENT) =
            (float)fabs((double)(i % EXTENT % size) - size / 2.0);
    return end(&relief, 0.6, 1.2);
}

const unseen_relief unseen_reliefs[] = {
    {"noise", noise},
    {"octaves", octaves},
    {"basket", basket},
    {"scales", scales},
    {"dunes", dunes},
    {"bricks", bricks},
    {"scratches", scratches},
    {"pyramids", pyramids},
    {"pits", pits},
    {"domes", domes},
    {"spikes", spikes},
    {"grooves", grooves},
    {0},
};
