#ifndef SCENES_SCENE_H
#define SCENES_SCENE_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Building a scene piece by piece. Each scene_add_... appends to its array and stores the index
/// of the new element in `*index` where that is not NULL; names are copied. On failure
/// (LOBE_ERROR_OUT_OF_MEMORY, logged) the scene is as it was and may be destroyed.

/// An empty scene with a black background, neither camera nor light.
lobe_result scenes_allocate(const char *name, const lobe_host *host, lobe_scene **scene);

/// Moves the texels into the scene; `image` is left empty, on failure too (freed then).
lobe_result scenes_add_image(lobe_scene *scene, const char *name, lobe_image *image,
                             const lobe_host *host, uint32_t *index);

/// Copies the material; its `name` field is ignored in favour of the parameter.
lobe_result scenes_add_material(lobe_scene *scene, const char *name, const lobe_material *material,
                                const lobe_host *host, uint32_t *index);

/// Moves the mesh into the scene, bounds computed; `mesh` is left empty, on failure too.
lobe_result scenes_add_mesh(lobe_scene *scene, lobe_mesh *mesh, const lobe_host *host,
                            uint32_t *index);

/// `transform` is column-major; NULL: the identity.
lobe_result scenes_add_instance(lobe_scene *scene, uint32_t mesh, uint32_t material,
                                const float transform[16], const lobe_host *host);

/// Adds a mesh and one instance of it, with a transform of identity. `mesh` is left empty, on
/// failure too.
lobe_result scenes_place_mesh(lobe_scene *scene, lobe_mesh *mesh, uint32_t material,
                              const lobe_host *host);

lobe_result scenes_add_light(lobe_scene *scene, const lobe_light *light, const lobe_host *host);

/// Where there is neither light nor environment, adds the environment "sky", with a notice; sets
/// `has_added_light`.
lobe_result scenes_add_missing_light(lobe_scene *scene, const lobe_host *host);

/// The last step: sets the scene's bounds; where `has_camera` is false, sets a camera that frames
/// them; where there is no light, adds some. Says so by notices. A scene without
/// instances stays dark and unsaid.
lobe_result scenes_complete(lobe_scene *scene, const lobe_host *host);

#endif
