#ifndef PASSES_UPLOAD_SCENE_CHECK_H
#define PASSES_UPLOAD_SCENE_CHECK_H

#include <lobe/scene.h>

/// Checks of a scene from a host or a file before it is uploaded: the device itself checks nothing.
/// The first error is logged in one line, and LOBE_ERROR_MALFORMED is returned.

/// Texels are finite.
lobe_result passes_scene_check_image(const lobe_scene *scene, size_t index, const lobe_host *host);
/// There are triangles, of vertices that exist and are finite.
lobe_result passes_scene_check_mesh(const lobe_scene *scene, size_t index, const lobe_host *host);
/// Counts and indices are in range.
lobe_result passes_scene_check_material(const lobe_scene *scene, size_t index,
                                        const lobe_host *host);
/// If there is one: texels are RGBA32_FLOAT, finite and not negative, and its matrix is a rotation.
lobe_result passes_scene_check_environment(const lobe_scene *scene, const lobe_host *host);

#endif
