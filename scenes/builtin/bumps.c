#include "scenes/builtin/builtin.h"

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/bump_maps.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"

// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", Fig. 4 bottom and section 5.2: hemispherical
// bumps with microfacet BRDFs that change quickly. Each bump is a metal of its own colour and
// roughness.

static lobe_result add_material(lobe_scene *scene, const lobe_host *host) {
    static const bump_style style = {
        .seed = 2017,
        .ground = {{234, 203, 180}, 128, true},
        .kinds = {{{245, 226, 190}, 0, true},
                  {{250, 196, 130}, 0, true},
                  {{236, 168, 140}, 0, true},
                  {{206, 214, 226}, 0, true}},
    };
    lobe_material material;
    lobe_material_default(&material);
    lobe_result status = scenes_bump_maps_add(scene, &style, host, &material);
    return status ? status : scenes_add_material(scene, "bumps", &material, host, NULL);
}

static lobe_result add_plane(lobe_scene *scene, const lobe_host *host) {
    lobe_mesh mesh;
    lobe_result status = scenes_shape_plane(48, 48, 0.22f, host, &mesh);
    return status ? status : scenes_place_mesh(scene, &mesh, 0, host);
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {-0.3f, -0.6f, 0.7416198f},
         .intensity = {2.2f, 2.1f, 1.9f}},
        {.type = LOBE_LIGHT_POINT, .position = {1.8f, 1.6f, -2.6f}, .intensity = {9, 6, 3.6f}},
        {.type = LOBE_LIGHT_POINT, .position = {-2.6f, 2.2f, -6}, .intensity = {6, 11, 18}},
    };
    scenes_set_camera(scene, (float[]){0, 2.2f, 1.0f}, (float[]){0, 0, -1.35f}, 42);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.25f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

lobe_result scenes_builtin_bumps(const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_material, add_plane, add_view, NULL};
    return scenes_builtin_assemble("bumps", steps, host, scene);
}
