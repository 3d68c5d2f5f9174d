#include "scenes/builtin/builtin.h"

#include <string.h>

#include "scenes/builtin/assembly.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"

// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", Fig. 4 top: two base BRDFs in a
// checkerboard, both with one lobe in the same direction. The lobes have the same colour, so that a
// footprint averages their widths alone.

enum { MAP_EXTENT = 1024, SQUARE_EXTENT = 8 };

static const float broad_width = 24, sharp_width = 512;
static const uint8_t broad_colour[4] = {214, 190, 152, 255}; // sRGB
static const uint8_t sharp_colour[4] = {66, 92, 122, 255};

static bool square_is_sharp(uint32_t column, uint32_t row) {
    return (column / SQUARE_EXTENT + row / SQUARE_EXTENT) % 2 != 0;
}

static void fill_width(uint32_t column, uint32_t row, void *texel) {
    *(float *)texel = square_is_sharp(column, row) ? sharp_width : broad_width;
}

static void fill_colour(uint32_t column, uint32_t row, void *texel) {
    memcpy(texel, square_is_sharp(column, row) ? sharp_colour : broad_colour, 4);
}

static lobe_result add_material(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map widths = {"checkerboard widths", LOBE_FORMAT_R32_FLOAT, MAP_EXTENT,
                                       MAP_EXTENT, fill_width};
    static const builtin_map colours = {"checkerboard colours", LOBE_FORMAT_RGBA8_SRGB, MAP_EXTENT,
                                        MAP_EXTENT, fill_colour};
    lobe_material material;
    lobe_material_default(&material);
    lobe_result status = scenes_builtin_add_map(scene, &widths, host, &material.width_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, &colours, host, &material.base_colour_map.image);
    if (status)
        return status;
    material.model = LOBE_MATERIAL_HALF_VECTOR_LOBES;
    material.distribution = LOBE_DISTRIBUTION_VMF;
    material.lobes[0] =
        (lobe_base_lobe){.direction = {0, 0, 1}, .width = 1, .colour = {0.06f, 0.06f, 0.06f}};
    material.lobe_count = 1;
    // There are two BRDFs and nothing in between.
    material.width_map.nearest = material.base_colour_map.nearest = true;
    return scenes_add_material(scene, "checkerboard", &material, host, NULL);
}

static lobe_result add_plane(lobe_scene *scene, const lobe_host *host) {
    lobe_mesh mesh;
    lobe_result status = scenes_shape_plane(160, 160, 1.5f, host, &mesh);
    return status ? status : scenes_place_mesh(scene, &mesh, 0, host);
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {-0.24f, -0.36f, 0.9015542f},
         .intensity = {1.3f, 1.25f, 1.15f}},
        {.type = LOBE_LIGHT_POINT, .position = {2.6f, 1.4f, -4.2f}, .intensity = {8, 5.2f, 3.2f}},
        {.type = LOBE_LIGHT_POINT, .position = {-5, 3.5f, -13}, .intensity = {16, 26, 40}},
    };
    scenes_set_camera(scene, (float[]){0, 1.5f, 0}, (float[]){0, 0, -4.2f}, 42);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.25f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

lobe_result scenes_builtin_checkerboard(const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_material, add_plane, add_view, NULL};
    return scenes_builtin_assemble("checkerboard", steps, host, scene);
}
