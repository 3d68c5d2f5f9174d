#ifndef TOOLS_SCENES_TERRAIN_SCENE_H
#define TOOLS_SCENES_TERRAIN_SCENE_H

#include <lobe/host.h>
#include <lobe/scene.h>

/// The scene "terrain": mountains around a valley, under sun and sky. Its heights and normals are
/// images of 8192 x 8192 texels that are made on the device (tools/animation/terrain_maps.h) and
/// are never on the host. Its camera flies a loop of twenty seconds, which begins and ends in the
/// valley. `assets` is ignored. The caller destroys the scene.
lobe_result terrain_scene(const char *assets, const lobe_host *host, lobe_scene **scene);

/// The names of its images.
#define TERRAIN_HEIGHTS "terrain heights"
#define TERRAIN_NORMALS "terrain normals"

/// Texels of its maps along each side, and the height 1 of them, in widths of the map.
#define TERRAIN_TEXELS 8192
#define TERRAIN_RELIEF 0.16

#endif
