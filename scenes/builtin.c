#include "scenes/builtin.h"

#include <string.h>

#include "scenes/scene.h"

static const builtin_scene table[] = {
    {{"checkerboard", "a plane of two lobe widths in fine squares, seen into the distance"},
     builtin_checkerboard},
    {{"bumps", "a plane of hemispherical bumps, each of its own metal and roughness"},
     builtin_bumps},
    {{"tablecloth", "a draped cloth with two lobes at 45 degrees and a noise normal map"},
     builtin_tablecloth},
};

size_t lobe_builtin_scene_count(void) {
    return sizeof table / sizeof table[0];
}

const lobe_builtin_scene *lobe_builtin_scene_get(size_t index) {
    return index < lobe_builtin_scene_count() ? &table[index].description : NULL;
}

const builtin_scene *builtin_scene_find(const char *name) {
    for (size_t i = 0; i < lobe_builtin_scene_count(); i++)
        if (strcmp(table[i].description.name, name) == 0)
            return &table[i];
    return NULL;
}

lobe_result builtin_scene_assemble(const char *name, const builtin_step *steps, const lobe_log *log,
                                   lobe_scene **scene) {
    *scene = NULL;
    lobe_result status = scene_allocate(name, log, scene);
    for (; !status && *steps; steps++)
        status = (*steps)(*scene, log);
    if (!status)
        status = scene_complete(*scene, log);
    if (status)
        lobe_scene_destroy(scene);
    return status;
}

void builtin_scene_look(lobe_scene *scene, const float eye[3], const float target[3],
                        float degrees) {
    lobe_camera camera = {.up = {0, 1, 0}, .near_plane = 0.05f};
    memcpy(camera.eye, eye, sizeof camera.eye);
    memcpy(camera.target, target, sizeof camera.target);
    camera.vertical_field_of_view = degrees * 0.017453292f;
    scene->camera = camera;
    scene->has_camera = true;
}

lobe_result builtin_scene_add_lights(lobe_scene *scene, const lobe_light *lights, size_t count,
                                     const lobe_log *log) {
    lobe_result status = LOBE_OK;
    for (size_t i = 0; !status && i < count; i++)
        status = scene_add_light(scene, &lights[i], log);
    return status;
}

lobe_texture_use builtin_scene_texture(uint32_t image) {
    lobe_texture_use use = LOBE_TEXTURE_NONE;
    use.image = (int32_t)image;
    return use;
}
