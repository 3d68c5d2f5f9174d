#include "tools/scenes/outdoors/ocean_scene.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/assembly.h"
#include "scenes/scene/scene.h"
#include "tools/scenes/outdoors/daylight_light.h"
#include "tools/scenes/outdoors/wide_grid.h"

void ocean_scene_sea(lobe_ocean_parameters *sea) {
    lobe_ocean_default(sea);
    // Towards the viewer, from the left.
    sea->wind_direction = -1.1f;
}

// ---------------------------------------------------------------------------------------------
// Water

/// It reflects 2 % at normal incidence, as a metal of that colour does, and shows some of the light
/// that it scatters.
static lobe_result add_material(lobe_scene *scene, const lobe_host *host) {
    static const float colour[4] = {0.02f, 0.02f, 0.02f, 1},
                       scattered[3] = {0.003f, 0.012f, 0.018f};
    lobe_material material;
    lobe_ocean_parameters sea;
    lobe_ocean_slopes slopes;
    ocean_scene_sea(&sea);
    lobe_result result = lobe_ocean_measure(&sea, host, &slopes);
    if (result != LOBE_OK)
        return result;
    lobe_material_default(&material);
    memcpy(material.base_colour, colour, sizeof colour);
    memcpy(material.emissive, scattered, sizeof scattered);
    material.metallic = 1;
    material.distribution = LOBE_DISTRIBUTION_BECKMANN;
    material.roughness = 0.05f;
    material.waves =
        (lobe_waves){.layers = sea.layers, .size = sea.size, .choppy = sea.choppiness > 0};
    memcpy(material.waves.lengths, sea.lengths, sizeof sea.lengths);
    memcpy(material.waves.rest, slopes.rest, sizeof slopes.rest);
    memcpy(material.waves.total, slopes.total, sizeof slopes.total);
    return scenes_add_material(scene, "water", &material, host, NULL);
}

/// A third of a metre from one row to the next in the middle, and 40 km in all.
static lobe_result add_plane(lobe_scene *scene, const lobe_host *host) {
    static const wide_grid sea = {
        .name = "sea", .cells = 128, .width = 2, .growth = 10.6, .tile = 1};
    return wide_grid_add(scene, &sea, host);
}

// ---------------------------------------------------------------------------------------------
// Light

/// The sun is 20 degrees high. Light from below never reaches the sea.
static lobe_result add_light(lobe_scene *scene, const lobe_host *host) {
    static const daylight_light light = {
        .name = "low sun", .sun = {0.1288, 0.3420, -0.9308}, .turbidity = 3, .ground = -1};
    return daylight_light_add(scene, &light, host);
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    (void)host;
    scenes_set_camera(scene, (float[]){0, 6, 0}, (float[]){0, 3.6f, -10}, 40);
    return LOBE_OK;
}

lobe_result ocean_scene(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_material, add_plane, add_light, add_view, NULL};
    (void)assets;
    return scenes_builtin_assemble("ocean", steps, host, scene);
}
