#include "scenes/scene/view.h"

#include <string.h>

#include "scenes/scene/scene.h"

void scenes_look(lobe_scene *scene, const float eye[3], const float target[3], float degrees) {
    lobe_camera camera = {.up = {0, 1, 0}, .near_plane = 0.05f};
    memcpy(camera.eye, eye, sizeof camera.eye);
    memcpy(camera.target, target, sizeof camera.target);
    camera.vertical_field_of_view = degrees * 0.017453292f;
    scene->camera = camera;
    scene->has_camera = true;
}

lobe_result scenes_add_lights(lobe_scene *scene, const lobe_light *lights, size_t count,
                              const lobe_host *host) {
    lobe_result status = LOBE_OK;
    for (size_t i = 0; !status && i < count; i++)
        status = scenes_add_light(scene, &lights[i], host);
    return status;
}
