#ifndef TOOLS_SCENES_OCEAN_SCENE_H
#define TOOLS_SCENES_OCEAN_SCENE_H

#include <lobe/host.h>
#include <lobe/ocean.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// A sea to the horizon, under a clear sky with a low sun in front. Its material has waves, which
/// tools/animation/animation.h gives from this sea. On failure `*scene` is NULL. `assets` is not
/// used.
lobe_result ocean_scene(const char *assets, const lobe_host *host, lobe_scene **scene);

/// The sea of the scene: x along +X, y along -Z.
void ocean_scene_sea(lobe_ocean_parameters *sea);

#endif
