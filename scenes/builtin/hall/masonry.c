#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/hall/hall.h"
#include "scenes/builtin/noise.h"
#include "scenes/builtin/random.h"
#include "scenes/scene/scene.h"

// Walls of sandstone ashlar; every other course is shifted by half a block.

enum { EXTENT = 512, COURSES = 8, BLOCKS = 4 };

typedef struct wall_point {
    uint32_t block, course;
    double x, y;         // within the block, each in [-1, 1]
    double side, bottom; // texels to the nearest upright and level joint
} wall_point;

static wall_point find_block(uint32_t column, uint32_t row) {
    const uint32_t width = EXTENT / BLOCKS, height = EXTENT / COURSES;
    wall_point point = {.course = row / height};
    uint32_t moved = (column + width / 2 * (point.course % 2)) % EXTENT;
    point.block = moved / width;
    point.x = (moved % width + 0.5) * 2 / width - 1;
    point.y = (row % height + 0.5) * 2 / height - 1;
    point.side = (1 - fabs(point.x)) * width / 2;
    point.bottom = (1 - fabs(point.y)) * height / 2;
    return point;
}

static double block_number(const wall_point *point, uint32_t which) {
    return scenes_random_lattice(point->block, point->course, which) / 2147483648.0 - 1;
}

static void fill_normal(uint32_t column, uint32_t row, void *texel) {
    wall_point point = find_block(column, row);
    double coarse[2], fine[2];
    scenes_noise_gradient((column + 0.5) / 16, (row + 0.5) / 16, EXTENT / 16, 51, coarse);
    scenes_noise_gradient((column + 0.5) / 3.2, (row + 0.5) / 3.2, 160, 52, fine);
    double fall_x = fmax(4 - point.side, 0) * 0.2, fall_y = fmax(4 - point.bottom, 0) * 0.2;
    scenes_normal_map_store_slope(texel,
                                  0.03 * block_number(&point, 53) + 0.12 * coarse[0] +
                                      0.22 * fine[0] - (point.x > 0 ? fall_x : -fall_x),
                                  0.03 * block_number(&point, 54) + 0.12 * coarse[1] +
                                      0.22 * fine[1] - (point.y > 0 ? fall_y : -fall_y));
}

static void fill_colour(uint32_t column, uint32_t row, void *texel) {
    static const double sandstone[3] = {196, 170, 134};
    wall_point point = find_block(column, row);
    double bed = scenes_noise_gradient(column / 64.0, row / 8.0, 64, 55, NULL);
    double grain = scenes_noise_gradient(column / 2.0, row / 2.0, EXTENT / 2, 56, NULL);
    double shade = 1 + 0.1 * block_number(&point, 57) + 0.1 * bed + 0.12 * grain;
    shade *= point.side < 1.5 || point.bottom < 1.5 ? 0.6 : 1;
    double warmth = 8 * block_number(&point, 58);
    uint8_t *channels = texel;
    for (int channel = 0; channel < 3; channel++)
        channels[channel] = (uint8_t)fmin(sandstone[channel] * shade + (1 - channel) * warmth, 255);
    channels[3] = 255;
}

static void fill_roughness(uint32_t column, uint32_t row, void *texel) {
    wall_point point = find_block(column, row);
    double grain = scenes_noise_gradient(column / 4.0, row / 4.0, EXTENT / 4, 59, NULL);
    uint8_t *channels = texel;
    channels[0] = channels[2] = 0, channels[3] = 255;
    channels[1] = (uint8_t)(255 * (0.58 + 0.08 * block_number(&point, 60) + 0.25 * grain));
}

lobe_result scenes_hall_add_masonry(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map normals = {"masonry normals", LOBE_FORMAT_RGBA8_UNORM, EXTENT, EXTENT,
                                        fill_normal};
    static const builtin_map colours = {"masonry colours", LOBE_FORMAT_RGBA8_SRGB, EXTENT, EXTENT,
                                        fill_colour};
    static const builtin_map roughness = {"masonry roughness", LOBE_FORMAT_RGBA8_UNORM, EXTENT,
                                          EXTENT, fill_roughness};
    return scenes_builtin_add_metal_rough(scene, "masonry", &normals, &colours, &roughness, host);
}
