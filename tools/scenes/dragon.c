#include "tools/scenes/asset_scene.h"

#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/noise.h"
#include "scenes/builtin/random.h"
#include "scenes/scene/scene.h"

// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", section 5.2: a dragon with a normal map of
// 2048 x 2048 texels and a BRDF map of 671 x 457, tiled. The normal map has overlapping, grainy
// scales; the BRDF is bronze with patches of patina.

enum { NORMAL_EXTENT = 2048, BRDF_WIDTH = 671, BRDF_HEIGHT = 457 };
enum { SCALE_COLUMNS = 64, SCALE_ROWS = 128 };

// The roundness of a scale, and the height of its tip above its root, in pitches.
static const double rounding = 0.55, overlap = 0.35;

// The middle of the scale in this row and column, slightly displaced, in pitches of columns and
// rows.
static void place_scale(int column, int row, double centre[2]) {
    uint32_t bits = scenes_random_lattice((uint32_t)(column & (SCALE_COLUMNS - 1)),
                                          (uint32_t)(row & (SCALE_ROWS - 1)), 31);
    centre[0] = column + (row & 1 ? 0.5 : 0) + ((bits & 0xffff) / 65535.0 - 0.5) * 0.12;
    centre[1] = row + ((bits >> 16) / 65535.0 - 0.5) * 0.2;
}

// The slope of the highest scale at a point; scales hang down, each over those below it. A scale
// extends 0.75 column pitches to the sides and 1.5 row pitches (half as long) downwards.
static void scale_slope(double x, double y, double slope[2]) {
    int near_row = (int)floor(y), near_column = (int)floor(x);
    double highest = -1;
    slope[0] = slope[1] = 0;
    for (int i = 0; i < 12; i++) {
        double centre[2];
        place_scale(near_column + i % 3 - 1, near_row + i / 3 - 2, centre);
        double dx = (x - centre[0]) / 0.75, dy = (y - centre[1]) / 1.5;
        double distance = dx * dx + dy * dy;
        double height = rounding * (1 - distance) + overlap * dy;
        if (distance >= 1 || height <= highest)
            continue;
        highest = height;
        slope[0] = -2 * rounding * dx;
        slope[1] = -2 * rounding * dy + overlap;
    }
}

static void fill_normal(uint32_t column, uint32_t row, void *texel) {
    double slope[2], grain[2];
    scale_slope((column + 0.5) * SCALE_COLUMNS / NORMAL_EXTENT,
                (row + 0.5) * SCALE_ROWS / NORMAL_EXTENT, slope);
    scenes_noise_gradient((column + 0.5) / 4, (row + 0.5) / 4, NORMAL_EXTENT / 4, 5, grain);
    scenes_normal_map_store_slope(texel, slope[0] * 0.6 + grain[0] * 0.08,
                                  slope[1] * 0.6 + grain[1] * 0.08);
}

// The amount of patina [0, 1]: none on most of the surface, with steep transitions.
static double patina(uint32_t column, uint32_t row) {
    static const uint32_t periods[] = {6, 17, 49};
    double sum = 0;
    for (uint32_t i = 0; i < sizeof periods / sizeof *periods; i++)
        sum += scenes_noise_gradient((column + 0.5) * periods[i] / BRDF_WIDTH,
                                     (row + 0.5) * periods[i] / BRDF_HEIGHT, periods[i], 40 + i,
                                     NULL) /
               (i + 1);
    return fmin(fmax((sum - 0.05) * 5, 0), 1);
}

static void fill_colour(uint32_t column, uint32_t row, void *texel) {
    static const double bronze[3] = {232, 178, 112}, green[3] = {86, 148, 124}; // sRGB
    double amount = patina(column, row);
    uint8_t *channels = texel;
    for (int channel = 0; channel < 3; channel++)
        channels[channel] =
            (uint8_t)(bronze[channel] + (green[channel] - bronze[channel]) * amount + 0.5);
    channels[3] = 255;
}

// Bronze is polished in fine, irregular strokes; patina is dull and not a metal.
static void fill_roughness(uint32_t column, uint32_t row, void *texel) {
    double amount = patina(column, row);
    double strokes = scenes_noise_gradient((column + 0.5) * 120 / BRDF_WIDTH,
                                           (row + 0.5) * 120 / BRDF_HEIGHT, 120, 50, NULL);
    double bare = 0.3 + 0.25 * strokes;
    uint8_t *channels = texel;
    channels[0] = channels[3] = 255;
    channels[1] = (uint8_t)((bare + (0.75 - bare) * amount) * 255 + 0.5);
    channels[2] = (uint8_t)((1 - amount) * 255 + 0.5);
}

static lobe_result add_material(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map normals = {"dragon normals", LOBE_FORMAT_RGBA8_UNORM, NORMAL_EXTENT,
                                        NORMAL_EXTENT, fill_normal};
    static const builtin_map colours = {"dragon colours", LOBE_FORMAT_RGBA8_SRGB, BRDF_WIDTH,
                                        BRDF_HEIGHT, fill_colour};
    static const builtin_map roughness = {"dragon roughness", LOBE_FORMAT_RGBA8_UNORM, BRDF_WIDTH,
                                          BRDF_HEIGHT, fill_roughness};
    return scenes_builtin_add_metal_rough(scene, "scales", &normals, &colours, &roughness, host);
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {0.48f, -0.64f, -0.6f},
         .intensity = {2.6f, 2.5f, 2.3f}},
        {.type = LOBE_LIGHT_POINT, .position = {0.5f, 0.4f, 0.3f}, .intensity = {0.4f, 0.5f, 0.7f}},
        {.type = LOBE_LIGHT_POINT,
         .position = {-0.4f, 0.5f, -0.4f},
         .intensity = {0.8f, 0.6f, 0.4f}},
    };
    scenes_set_camera(scene, (float[]){-0.08f, 0.2f, 0.55f}, (float[]){0, 0.088f, 0}, 24);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.25f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

lobe_result asset_scene_dragon(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const asset_mesh mesh = {.scene = "dragon",
                                    .file = "models/npm_dragon_vrip_res3.ply.gz",
                                    .height = 0.18,
                                    .tile = 0.14};
    static const builtin_step steps[] = {add_material, add_view, NULL};
    return asset_scene_assemble(&mesh, assets, steps, host, scene);
}
