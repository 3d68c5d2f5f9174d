#include "tests/passes/filters/displaced/relief_sides.h"

#include <math.h>

#include "tests/passes/support/slope_plane.h"

enum { SIDE = 8 };

/// Moves heights into the range of relief_plane's maps.
static lobe_image in_units_of_map(lobe_image heights) {
    float *texels = heights.texels;
    for (size_t i = 0; i < 4 * (size_t)heights.width * heights.height; i += 4)
        texels[i] = relief_map_value((double)texels[i]);
    return heights;
}

static void direction_in_world(relief_side from, double direction[3]) {
    double tangent[3];
    slope_plane_direction(90 - from.height, from.azimuth * M_PI / 180, tangent);
    direction[0] = tangent[0];
    direction[1] = tangent[2];
    direction[2] = -tangent[1];
}

lobe_scene *relief_sides_plane(const lobe_material *material, lobe_image map, double tiles,
                               bool sky) {
    lobe_scene *scene =
        relief_plane(material, in_units_of_map(map), (const double[]){0, 0, 1}, tiles);
    if (sky)
        relief_plane_add_sky(scene);
    else
        relief_plane_add_sun(scene, (const double[]){0, 0, 1}, 1);
    scene_end(scene);
    return scene;
}

void relief_sides_look(lobe_scene *scene, relief_side viewer) {
    double eye[3];
    direction_in_world(viewer, eye);
    for (int i = 0; i < 3; i++)
        scene->camera.eye[i] = (float)(4 * eye[i]);
}

void relief_sides_shine(lobe_scene *scene, relief_side sun) {
    double light[3];
    direction_in_world(sun, light);
    for (int i = 0; i < 3; i++)
        scene->lights[0].direction[i] = (float)-light[i];
}

relief_mean relief_sides_draw(fixture *f, const lobe_scene *scene, const char *filter,
                              uint32_t samples) {
    const picture_request request = {.filter = filter,
                                     .settings = {"env_size=16"},
                                     .width = SIDE,
                                     .height = SIDE,
                                     .samples = samples};
    lobe_frame frame = draw_scene(f, scene, &request);
    double sum = 0, squares = 0;
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const double value = (double)pixel_at(&frame.radiance, i % SIDE, i / SIDE)[1];
        sum += value;
        squares += value * value;
    }
    lobe_frame_free(&frame);
    const double mean = sum / (SIDE * SIDE);
    const double variance = fmax(squares / (SIDE * SIDE) - mean * mean, 0);
    return (relief_mean){mean, sqrt(variance / (SIDE * SIDE - 1))};
}
