#include "tests/passes/filters/displaced/relief_waves.h"

#include <math.h>

#include "tests/passes/filters/displaced/relief_plane.h"
#include "tests/passes/support/slope_plane.h"

/// Of a map of 128 texels.
static double broad_waves(uint32_t column, uint32_t row) {
    const double x = 2 * M_PI * column / 128, y = 2 * M_PI * row / 128;
    return 9 * sin(x) * cos(y) + 0.5 * sin(19 * x + 7 * y);
}

static lobe_image waves_map(void) {
    return relief_map(128, 128, broad_waves);
}

static lobe_frame draw_waves(fixture *f, lobe_image map, const char *filter,
                             const char *const *settings, uint32_t texels, uint32_t samples) {
    double outgoing[3];
    const double incoming[3] = {0.6, 0.3, 0.742};
    slope_plane_direction(30, 0.9, outgoing);
    const lobe_material material = relief_material(0.8);
    lobe_scene *scene = relief_plane(&material, map, outgoing, texels / 8.0);
    relief_plane_add_sun(scene, incoming, 1);
    scene_end(scene);
    picture_request request = {
        .filter = filter, .settings = {NULL}, .width = 16, .height = 16, .samples = samples};
    for (size_t i = 0; settings[i]; i++)
        request.settings[i] = settings[i];
    lobe_frame frame = draw_scene(f, scene, &request);
    lobe_scene_destroy(&scene);
    return frame;
}

void relief_waves_check(fixture *f, const char *filter, const char *const *settings,
                        uint32_t texels, double bound) {
    static const char *const none[] = {NULL};
    lobe_frame reference = draw_waves(f, waves_map(), "displaced-reference", none, texels, 256);
    lobe_frame found = draw_waves(f, waves_map(), filter, settings, texels, 1);
    // One texel is flat.
    lobe_frame flat = draw_waves(f, relief_map(1, 1, broad_waves), "mipmap", none, texels, 1);
    const double error = relative_l2(&found.radiance, &reference.radiance),
                 of_flat = relative_l2(&flat.radiance, &reference.radiance);
    lobe_frame_free(&reference);
    lobe_frame_free(&found);
    lobe_frame_free(&flat);
    if (!(error <= bound && error < of_flat))
        fail_msg("%u texels a pixel: %.4f, flat %.4f", texels, error, of_flat);
}
