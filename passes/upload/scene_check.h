#ifndef PASSES_UPLOAD_SCENE_CHECK_H
#define PASSES_UPLOAD_SCENE_CHECK_H

#include <lobe/scene.h>

/// Checks of a scene from a host or a file before it is uploaded: the device itself checks nothing.
/// The first error is logged in one line, and LOBE_ERROR_MALFORMED is returned.

/// Whether its channels can be negative: signed normals need that.
bool passes_format_has_sign(lobe_format format);
/// Whether its channels but alpha are encoded with the sRGB curve: those of normals are not.
bool passes_format_is_srgb(lobe_format format);
/// How many channels normals of an encoding take.
uint32_t passes_normal_channels(lobe_normal_encoding encoding);
/// Whether an image is the normal map of a material.
bool passes_scene_has_normals_in(const lobe_scene *scene, size_t image);

/// There is something to draw, and an array wherever there is a count.
lobe_result passes_scene_check_arrays(const lobe_scene *scene, const lobe_host *host);
/// There is an array of instances if they are counted, and they can be numbered (LOBE_ERROR_LIMIT).
lobe_result passes_scene_check_instance_array(const lobe_scene *scene, const lobe_host *host);
/// There are texels, of a format that can be sampled, and those of the part (NULL: all) are finite.
lobe_result passes_scene_check_image(const lobe_scene *scene, size_t index,
                                     const lobe_rectangle *part, const lobe_host *host);
/// The format of an image that is a normal map is linear, and has the channels of its encoding.
lobe_result passes_scene_check_normals(const lobe_scene *scene, size_t index,
                                       const lobe_host *host);
/// There are triangles, of vertices that exist, are finite and have normals.
lobe_result passes_scene_check_mesh(const lobe_scene *scene, size_t index, const lobe_host *host);
/// Counts, indices and numbers are in range. In material_check.c.
lobe_result passes_scene_check_material(const lobe_scene *scene, size_t index,
                                        const lobe_host *host);
/// If there is one: texels are RGBA32_FLOAT, finite and not negative, and have its layout's shape.
lobe_result passes_scene_check_environment(const lobe_scene *scene, const lobe_host *host);

#endif
