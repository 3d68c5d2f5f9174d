#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/hall/hall.h"
#include "scenes/builtin/noise.h"
#include "scenes/scene/scene.h"

// Wool with an eight-pointed star and borders of gold thread: a broad lobe and a sharp one, over
// the slubs of the yarn.

enum { EXTENT = 512 };

static bool is_gold(uint32_t column, uint32_t row) {
    // Whole stitches, two texels wide.
    double x = (column / 2 * 2 + 1) / (EXTENT / 2.0) - 1,
           y = (row / 2 * 2 + 1) / (EXTENT / 2.0) - 1;
    double upright = fmax(fabs(x), fabs(y)), slanted = (fabs(x) + fabs(y)) * 0.70710678;
    bool star = fmin(upright, slanted) < 0.36 && fmax(upright, slanted) > 0.2;
    bool border = fabs(x) > 0.80 && fabs(x) < 0.90;
    return (star || border) && (column / 2 + row / 2) % 3 != 0;
}

static void fill_normal(uint32_t column, uint32_t row, void *texel) {
    double slub[2], yarn[2];
    scenes_noise_gradient((column + 0.5) / 16, (row + 0.5) / 16, EXTENT / 16, 81, slub);
    scenes_noise_gradient((column + 0.5) / 3.2, (row + 0.5) / 3.2, 160, 82, yarn);
    double rough = is_gold(column, row) ? 0.15 : 0.3;
    scenes_normal_map_store_slope(texel, 0.06 * slub[0] + rough * yarn[0],
                                  0.06 * slub[1] + rough * yarn[1]);
}

static void store_colour(uint8_t *texel, const double colour[3], double scale) {
    for (int channel = 0; channel < 3; channel++)
        texel[channel] = (uint8_t)fmin(colour[channel] * scale, 255);
    texel[3] = 255;
}

static void fill_diffuse(uint32_t column, uint32_t row, void *texel) {
    static const double wool[3] = {150, 28, 36}, gold[3] = {170, 122, 56};
    double grain = 1 + 0.3 * scenes_noise_gradient(column / 2.0, row / 2.0, EXTENT / 2, 83, NULL);
    store_colour(texel, is_gold(column, row) ? gold : wool, grain);
}

static void fill_specular(uint32_t column, uint32_t row, void *texel) {
    static const double wool[3] = {110, 60, 60}, gold[3] = {255, 206, 128};
    store_colour(texel, is_gold(column, row) ? gold : wool, 1);
}

static void fill_exponent(uint32_t column, uint32_t row, void *texel) {
    *(float *)texel = is_gold(column, row) ? 180 : 6;
}

lobe_result scenes_hall_add_cloth(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map normals = {"cloth normals", LOBE_FORMAT_RGBA8_UNORM, EXTENT, EXTENT,
                                        fill_normal};
    static const builtin_map diffuse = {"cloth diffuse colours", LOBE_FORMAT_RGBA8_SRGB, EXTENT,
                                        EXTENT, fill_diffuse};
    static const builtin_map specular = {"cloth specular colours", LOBE_FORMAT_RGBA8_SRGB, EXTENT,
                                         EXTENT, fill_specular};
    static const builtin_map exponents = {"cloth exponents", LOBE_FORMAT_R32_FLOAT, EXTENT, EXTENT,
                                          fill_exponent};
    lobe_material material;
    lobe_material_default(&material);
    lobe_result status = scenes_builtin_add_map(scene, &normals, host, &material.normal_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, &diffuse, host, &material.base_colour_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, &specular, host, &material.specular_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, &exponents, host, &material.width_map.image);
    if (status)
        return status;
    material.model = LOBE_MATERIAL_HALF_VECTOR_LOBES;
    material.distribution = LOBE_DISTRIBUTION_BLINN_PHONG;
    material.lobes[0] =
        (lobe_base_lobe){.direction = {0, 0, 1}, .width = 1, .colour = {0.12f, 0.12f, 0.12f}};
    material.lobe_count = 1;
    material.double_sided = true;
    return scenes_add_material(scene, "cloth", &material, host, NULL);
}
