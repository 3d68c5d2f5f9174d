#ifndef PASSES_UPLOAD_SCENE_CHECK_H
#define PASSES_UPLOAD_SCENE_CHECK_H

#include <lobe/scene.h>

/// Checks of what a host or a file put into a scene, before it goes to the device, which would
/// show nonsense or worse. One line and LOBE_ERROR_MALFORMED for the first fault.

/// Texels are finite.
lobe_result passes_scene_check_image(const lobe_scene *scene, size_t index, const lobe_host *host);
/// There are triangles, of vertices that exist and are finite.
lobe_result passes_scene_check_mesh(const lobe_scene *scene, size_t index, const lobe_host *host);
/// Counts and indices are in range.
lobe_result passes_scene_check_material(const lobe_scene *scene, size_t index,
                                        const lobe_host *host);
/// Where there is one: texels are RGBA32_FLOAT, finite and not negative; its rotation is one.
lobe_result passes_scene_check_environment(const lobe_scene *scene, const lobe_host *host);

#endif
