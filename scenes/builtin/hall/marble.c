#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/hall/hall.h"
#include "scenes/builtin/noise.h"
#include "scenes/scene/scene.h"

// Green marble with pale veins. The polish has worn off the veins, which stand a little higher.

enum { EXTENT = 512 };

// Signed distance from a vein, in no particular unit; veins are thin lines where it crosses 0.
static double vein_field(uint32_t column, uint32_t row) {
    double across = (column + 0.5) / EXTENT, down = (row + 0.5) / EXTENT;
    double bend = scenes_noise_gradient(across * 9, down * 9, 9, 61, NULL);
    return scenes_noise_gradient(across * 4 + 0.9 * bend, down * 4 + 0.5 * bend, 4, 62, NULL) +
           0.3 * scenes_noise_gradient(across * 13, down * 13, 13, 63, NULL);
}

static double vein(uint32_t column, uint32_t row) {
    return fmax(1 - fabs(vein_field(column, row)) * 22, 0);
}

static void fill_normal(uint32_t column, uint32_t row, void *texel) {
    double wave[2], scratch[2];
    scenes_noise_gradient((column + 0.5) / 16, (row + 0.5) / 16, EXTENT / 16, 64, wave);
    scenes_noise_gradient((column + 0.5) / 3.2, (row + 0.5) / 3.2, 160, 65, scratch);
    double rough = 0.05 + 0.25 * vein(column, row);
    scenes_normal_map_store_slope(texel, 0.04 * wave[0] + rough * scratch[0],
                                  0.04 * wave[1] + rough * scratch[1]);
}

static void fill_colour(uint32_t column, uint32_t row, void *texel) {
    static const double green[3] = {84, 106, 92}, white[3] = {222, 220, 206};
    double share = vein(column, row), cloud = 0.5 + 0.7 * vein_field(column, row);
    uint8_t *channels = texel;
    for (int channel = 0; channel < 3; channel++) {
        double stone = green[channel] * (0.7 + 0.6 * fmin(fmax(cloud, 0), 1));
        channels[channel] = (uint8_t)(stone + (white[channel] - stone) * share);
    }
    channels[3] = 255;
}

static void fill_roughness(uint32_t column, uint32_t row, void *texel) {
    double smear = scenes_noise_gradient(column / 64.0, row / 32.0, 16, 66, NULL);
    uint8_t *channels = texel;
    channels[0] = channels[2] = 0, channels[3] = 255;
    channels[1] = (uint8_t)(255 * (0.27 + 0.1 * smear + 0.3 * vein(column, row)));
}

lobe_result scenes_hall_add_marble(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map normals = {"marble normals", LOBE_FORMAT_RGBA8_UNORM, EXTENT, EXTENT,
                                        fill_normal};
    static const builtin_map colours = {"marble colours", LOBE_FORMAT_RGBA8_SRGB, EXTENT, EXTENT,
                                        fill_colour};
    static const builtin_map roughness = {"marble roughness", LOBE_FORMAT_RGBA8_UNORM, EXTENT,
                                          EXTENT, fill_roughness};
    return scenes_builtin_add_metal_rough(scene, "marble", &normals, &colours, &roughness, host);
}
