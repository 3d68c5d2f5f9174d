#ifndef SCENES_SCENE_VIEW_H
#define SCENES_SCENE_VIEW_H

#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Camera and lights of the scenes that are made by code.

/// Sets the camera: where it stands, what it looks at, its vertical field of view in degrees.
void scenes_look(lobe_scene *scene, const float eye[3], const float target[3], float degrees);

/// Adds `count` lights. Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_add_lights(lobe_scene *scene, const lobe_light *lights, size_t count,
                              const lobe_host *host);

#endif
