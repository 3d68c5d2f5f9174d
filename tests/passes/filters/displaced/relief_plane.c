#include "tests/passes/filters/displaced/relief_plane.h"

#include <math.h>

enum { SIDE = 8 };

/// What the range [0, 1] of a map spans, in widths of a texel: the precision of floats is 6e-5.
static const float relief_range = 1024;

float relief_map_value(double height) {
    return (float)(0.5 + height / (double)relief_range);
}

lobe_image relief_map(uint32_t width, uint32_t height, relief_height height_at) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    for (uint32_t i = 0; i < width * height; i++)
        ((float *)image.texels)[4 * i] = relief_map_value(height_at(i % width, i / width));
    return image;
}

double relief_map_height(const lobe_image *map, uint32_t column, uint32_t row) {
    const size_t texel = (size_t)(row % map->height) * map->width + column % map->width;
    return ((double)((const float *)map->texels)[4 * texel] - 0.5) * (double)relief_range;
}

lobe_material relief_material(double albedo) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 10);
    for (int i = 0; i < 3; i++) {
        material.base_colour[i] = (float)albedo;
        material.lobes[0].colour[i] = 0;
    }
    return material;
}

static void to_world(const double tangent[3], double world[3]) {
    world[0] = tangent[0];
    world[1] = tangent[2];
    world[2] = -tangent[1];
}

lobe_scene *relief_plane(const lobe_material *material, lobe_image map, const double outgoing[3],
                         double tiles) {
    lobe_scene *scene = scene_begin();
    lobe_material mapped = *material;
    mapped.height_scale = relief_range / (float)map.width;
    mapped.height_map = scene_add_map(scene, map);
    // The picture shows a tenth of the square's width, and more of it along the view.
    scene_add_square(scene, &mapped, 10 * tiles, NULL);
    double world[3];
    to_world(outgoing, world);
    scene_look_from(scene, world, 0.2);
    return scene;
}

void relief_plane_add_sun(lobe_scene *scene, const double incoming[3], double irradiance) {
    double world[3];
    to_world(incoming, world);
    scene_add_sun(scene, world, irradiance);
}

static void shine(const double direction[3], float radiance[3]) {
    (void)direction;
    for (int i = 0; i < 3; i++)
        radiance[i] = 1;
}

void relief_plane_add_sky(lobe_scene *scene) {
    scene_surround(scene, 16, shine);
}

void relief_plane_draw_colour(fixture *f, lobe_scene *scene, const char *filter,
                              const char *setting, uint32_t samples, double mean[3]) {
    scene_end(scene);
    picture_request request = {.filter = filter,
                               .settings = {"env_size=16", setting},
                               .width = SIDE,
                               .height = SIDE,
                               .samples = samples / (SIDE * SIDE)};
    lobe_frame frame = draw_scene(f, scene, &request);
    for (int channel = 0; channel < 3; channel++) {
        double sum = 0;
        for (uint32_t i = 0; i < SIDE * SIDE; i++)
            sum += (double)pixel_at(&frame.radiance, i % SIDE, i / SIDE)[channel];
        mean[channel] = sum / (SIDE * SIDE);
    }
    lobe_frame_free(&frame);
}

double relief_plane_draw(fixture *f, lobe_scene *scene, const char *filter, const char *setting,
                         uint32_t samples) {
    double mean[3];
    relief_plane_draw_colour(f, scene, filter, setting, samples, mean);
    return mean[1];
}
