#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/hall/hall.h"
#include "scenes/builtin/noise.h"
#include "scenes/scene/scene.h"

// Hammered bronze with verdigris, which is not a metal, in its hollows.

enum { EXTENT = 512, DENTS = 48 };

static double height(uint32_t column, uint32_t row, double slope[2]) {
    const double scale = (double)DENTS / EXTENT;
    return scenes_noise_gradient((column + 0.5) * scale, (row + 0.5) * scale, DENTS, 71, slope);
}

// 0 on bare metal, 1 under verdigris.
static double verdigris(uint32_t column, uint32_t row) {
    double patch =
        scenes_noise_gradient((column + 0.5) / 64, (row + 0.5) / 64, EXTENT / 64, 72, NULL);
    double amount = 1.4 * patch - 1.6 * height(column, row, NULL) - 0.1;
    return fmin(fmax(amount * 4, 0), 1);
}

static void fill_normal(uint32_t column, uint32_t row, void *texel) {
    double slope[2], grain[2], rough = 0.04 + 0.3 * verdigris(column, row);
    height(column, row, slope);
    scenes_noise_gradient((column + 0.5) / 3.2, (row + 0.5) / 3.2, 160, 73, grain);
    scenes_normal_map_store_slope(texel, 0.22 * slope[0] + rough * grain[0],
                                  0.22 * slope[1] + rough * grain[1]);
}

static void fill_colour(uint32_t column, uint32_t row, void *texel) {
    static const double metal[3] = {226, 168, 104}, crust[3] = {92, 148, 128};
    double share = verdigris(column, row);
    uint8_t *channels = texel;
    for (int channel = 0; channel < 3; channel++)
        channels[channel] = (uint8_t)(metal[channel] + (crust[channel] - metal[channel]) * share);
    channels[3] = 255;
}

static void fill_roughness(uint32_t column, uint32_t row, void *texel) {
    double share = verdigris(column, row);
    uint8_t *channels = texel;
    channels[0] = 0, channels[3] = 255;
    channels[1] = (uint8_t)(255 * (0.3 + 0.5 * share));
    channels[2] = (uint8_t)(255 * (1 - share));
}

lobe_result scenes_hall_add_bronze(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map normals = {"bronze normals", LOBE_FORMAT_RGBA8_UNORM, EXTENT, EXTENT,
                                        fill_normal};
    static const builtin_map colours = {"bronze colours", LOBE_FORMAT_RGBA8_SRGB, EXTENT, EXTENT,
                                        fill_colour};
    static const builtin_map roughness = {"bronze roughness", LOBE_FORMAT_RGBA8_UNORM, EXTENT,
                                          EXTENT, fill_roughness};
    return scenes_builtin_add_metal_rough(scene, "bronze", &normals, &colours, &roughness, host);
}
