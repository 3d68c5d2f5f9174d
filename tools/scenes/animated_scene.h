#ifndef TOOLS_SCENES_ANIMATED_SCENE_H
#define TOOLS_SCENES_ANIMATED_SCENE_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Built-in scenes with a normal map that changes with time: an image of the scene's name that is
/// `on_device`, and that tools/animation/animation.h makes from the still map, which is an image
/// without a material. On failure `*scene` is NULL. `assets` is not used.

lobe_result animated_scene_rain(const char *assets, const lobe_host *host, lobe_scene **scene);
lobe_result animated_scene_cloth(const char *assets, const lobe_host *host, lobe_scene **scene);

#endif
