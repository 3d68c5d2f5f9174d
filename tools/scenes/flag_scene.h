#ifndef TOOLS_SCENES_FLAG_SCENE_H
#define TOOLS_SCENES_FLAG_SCENE_H

#include <lobe/host.h>
#include <lobe/scene.h>

/// The scene "flag": canvas with a relief of threads (a height map), which waves and is stretched
/// by gusts. Its animation repeats after four seconds. `assets` is ignored. The caller destroys the
/// scene.
lobe_result flag_scene(const char *assets, const lobe_host *host, lobe_scene **scene);

#endif
