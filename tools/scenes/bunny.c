#include "tools/scenes/asset_scene.h"

#include "scenes/builtin/bump_maps.h"
#include "scenes/scene/scene.h"

// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", section 5.2: a bunny with a normal map of
// hemispherical bumps and a material map, 1024 x 1024 texels each. Bumps are metal or lacquer, so
// that colourless reflections are next to coloured ones.

static lobe_result add_material(lobe_scene *scene, const lobe_host *host) {
    static const bump_style style = {
        .seed = 1994,
        .ground = {{222, 214, 204}, 110, true},
        .kinds = {{{255, 205, 120}, 0, true},
                  {{238, 160, 128}, 0, true},
                  {{28, 74, 148}, 0, false},
                  {{150, 26, 34}, 0, false}},
    };
    lobe_material material;
    lobe_material_default(&material);
    lobe_result status = scenes_bump_maps_add(scene, &style, host, &material);
    return status ? status : scenes_add_material(scene, "bumps", &material, host, NULL);
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {-0.48f, -0.64f, -0.6f},
         .intensity = {2.4f, 2.3f, 2.1f}},
        {.type = LOBE_LIGHT_POINT,
         .position = {-0.5f, 0.35f, 0.25f},
         .intensity = {0.3f, 0.4f, 0.6f}},
        {.type = LOBE_LIGHT_POINT,
         .position = {0.3f, 0.45f, -0.4f},
         .intensity = {0.5f, 0.4f, 0.3f}},
    };
    scenes_set_camera(scene, (float[]){0.05f, 0.24f, 0.5f}, (float[]){0, 0.1f, 0}, 26);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.25f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

lobe_result asset_scene_bunny(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const asset_mesh mesh = {
        .scene = "bunny", .file = "models/npm_bunny.js", .height = 0.2, .tile = 0.06};
    static const builtin_step steps[] = {add_material, add_view, NULL};
    return asset_scene_assemble(&mesh, assets, steps, host, scene);
}
