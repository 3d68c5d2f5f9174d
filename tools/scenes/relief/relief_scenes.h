#ifndef TOOLS_SCENES_RELIEF_RELIEF_SCENES_H
#define TOOLS_SCENES_RELIEF_RELIEF_SCENES_H

#include <lobe/host.h>
#include <lobe/scene.h>

/// A ball on a floor, both with height maps of 256 x 256 texels. The camera sees the ball up close,
/// one to two texels to a pixel of a picture 144 pixels high; the scene's path zooms out to 64
/// times that distance. `assets` is ignored. The caller destroys the scene.

/// Twill of two colours, a thread to 16 texels.
lobe_result relief_scene_twill(const char *assets, const lobe_host *host, lobe_scene **scene);
/// Stones with dark joints between them.
lobe_result relief_scene_cobbles(const char *assets, const lobe_host *host, lobe_scene **scene);
/// Half spheres on the ball, noise on the floor; diffuse.
lobe_result relief_scene_studs(const char *assets, const lobe_host *host, lobe_scene **scene);
/// The same, white, in light that is white on all sides: a filter that loses no light shows
/// nothing.
lobe_result relief_scene_furnace(const char *assets, const lobe_host *host, lobe_scene **scene);

#endif
