#ifndef TOOLS_SCENES_FIELDS_SCENE_H
#define TOOLS_SCENES_FIELDS_SCENE_H

#include <lobe/host.h>
#include <lobe/scene.h>

/// The scene "fields": two kinds of bumps side by side, up close; its path zooms out to 64 times
/// the distance. `assets` is ignored. The caller destroys the scene.
lobe_result fields_scene(const char *assets, const lobe_host *host, lobe_scene **scene);

#endif
