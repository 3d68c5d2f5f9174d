#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/hall/hall.h"
#include "scenes/builtin/noise.h"
#include "scenes/builtin/random.h"
#include "scenes/scene/scene.h"

// A floor of alternating dark and light marble slabs, worn and wet: polished apart from grit, with
// open joints, and a brass lozenge let into each light slab. Towards a light its small bumps
// glitter; the smaller the pixels, the fewer texels glitter in each.

enum { NORMAL_EXTENT = 2048, COLOUR_EXTENT = 1024, SLABS = 8 };

// A point on the floor's tile.
typedef struct floor_point {
    uint32_t column, row; // of the slab
    double x, y;          // within it, each in [-1, 1]
    double edge;          // 0 in the slab's middle, 1 at its joint
    bool light, brass, joint;
} floor_point;

static floor_point find_slab(uint32_t column, uint32_t row, uint32_t extent) {
    uint32_t slab = extent / SLABS;
    floor_point point = {.column = column / slab, .row = row / slab};
    point.x = (column % slab + 0.5) * 2 / slab - 1;
    point.y = (row % slab + 0.5) * 2 / slab - 1;
    point.edge = fmax(fabs(point.x), fabs(point.y));
    point.light = (point.column + point.row) % 2 == 0;
    point.brass = point.light && fabs(fabs(point.x) + fabs(point.y) - 0.66) < 0.045;
    point.joint = point.edge > 0.975;
    return point;
}

// How wet the floor is: from 0, dry, to 1, under a film of water. `column` and `row` are in tiles.
static double wetness(double column, double row) {
    double puddles = scenes_noise_gradient(column * 6, row * 6, 6, 31, NULL);
    return fmin(fmax(0.45 + 2.2 * puddles, 0), 1);
}

// A random number in [-1, 1) for a slab; `which` selects one of several.
static double slab_number(const floor_point *point, uint32_t which) {
    return scenes_random_lattice(point->column, point->row, which) / 2147483648.0 - 1;
}

static void fill_normal(uint32_t column, uint32_t row, void *texel) {
    floor_point point = find_slab(column, row, NORMAL_EXTENT);
    double across = (column + 0.5) / NORMAL_EXTENT, down = (row + 0.5) / NORMAL_EXTENT;
    double swell[2], grit[2];
    scenes_noise_gradient(across * 48, down * 48, 48, 32, swell);
    scenes_noise_gradient(across * 400, down * 400, 400, 33, grit);
    double rough = point.brass ? 0.08 : 0.09 + 0.06 * slab_number(&point, 41);
    double slope[2] = {0.012 * slab_number(&point, 34) + 0.018 * swell[0] + rough * grit[0],
                       0.012 * slab_number(&point, 35) + 0.018 * swell[1] + rough * grit[1]};
    // Slabs are rounded towards their joints.
    double fall = fmax(point.edge - 0.93, 0) * 14;
    if (fabs(point.x) > fabs(point.y))
        slope[0] -= point.x > 0 ? fall : -fall;
    else
        slope[1] -= point.y > 0 ? fall : -fall;
    scenes_normal_map_store_slope(texel, slope[0], slope[1]);
}

static void fill_colour(uint32_t column, uint32_t row, void *texel) {
    static const double stone[2][3] = {{58, 50, 52}, {202, 188, 166}}, brass[3] = {236, 190, 104};
    static const double mortar[3] = {84, 78, 70};
    floor_point point = find_slab(column, row, COLOUR_EXTENT);
    double across = (column + 0.5) / COLOUR_EXTENT, down = (row + 0.5) / COLOUR_EXTENT;
    double cloud = scenes_noise_gradient(across * 40, down * 40, 40, 36, NULL);
    // Thin where the noise changes sign; each slab is cut from a different place.
    double vein = scenes_noise_gradient(across * 14 + 0.4 * cloud,
                                        down * 14 + 3 * slab_number(&point, 37), 14, 38, NULL);
    double shade = 1 + 0.12 * slab_number(&point, 39) + 0.14 * cloud;
    double pale = fmax(1 - fabs(vein) * 22, 0) * (point.light ? -28 : 70);
    const double *colour = point.joint ? mortar : point.brass ? brass : stone[point.light];
    bool plain = point.joint || point.brass;
    uint8_t *channels = texel;
    for (int channel = 0; channel < 3; channel++)
        channels[channel] =
            (uint8_t)fmin(fmax(colour[channel] * (plain ? 1 : shade) + (plain ? 0 : pale), 0), 255);
    channels[3] = 255;
}

static void fill_roughness(uint32_t column, uint32_t row, void *texel) {
    floor_point point = find_slab(column, row, COLOUR_EXTENT);
    double across = (column + 0.5) / COLOUR_EXTENT, down = (row + 0.5) / COLOUR_EXTENT;
    double wet = wetness(across, down), dry = point.joint ? 0.8 : point.brass ? 0.34 : 0.42;
    double grain = 1 + 0.25 * slab_number(&point, 40);
    uint8_t *channels = texel;
    channels[0] = 0, channels[3] = 255;
    channels[1] = (uint8_t)(255 * (0.14 * wet + dry * grain * (1 - wet)));
    channels[2] = point.brass && !point.joint ? 255 : 0;
}

lobe_result scenes_hall_add_floor(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map normals = {"floor normals", LOBE_FORMAT_RGBA8_UNORM, NORMAL_EXTENT,
                                        NORMAL_EXTENT, fill_normal};
    static const builtin_map colours = {"floor colours", LOBE_FORMAT_RGBA8_SRGB, COLOUR_EXTENT,
                                        COLOUR_EXTENT, fill_colour};
    static const builtin_map roughness = {"floor roughness", LOBE_FORMAT_RGBA8_UNORM, COLOUR_EXTENT,
                                          COLOUR_EXTENT, fill_roughness};
    return scenes_builtin_add_metal_rough(scene, "floor", &normals, &colours, &roughness, host);
}
