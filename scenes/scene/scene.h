#ifndef SCENES_SCENE_H
#define SCENES_SCENE_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Building a scene piece by piece. Each scenes_add_... appends to its array and stores the index
/// of the new element in `*index` unless that is NULL; names are copied. On failure
/// (LOBE_ERROR_OUT_OF_MEMORY, logged) the scene is unchanged and may be destroyed.

/// An empty scene with a black background, without camera and light.
lobe_result scenes_allocate(const char *name, const lobe_host *host, lobe_scene **scene);

/// Moves the texels into the scene. `image` is left empty, also on failure, when it is freed.
lobe_result scenes_add_image(lobe_scene *scene, const char *name, lobe_image *image,
                             const lobe_host *host, uint32_t *index);

/// Copies the material; its `name` field is ignored in favour of the parameter.
lobe_result scenes_add_material(lobe_scene *scene, const char *name, const lobe_material *material,
                                const lobe_host *host, uint32_t *index);

/// Moves the mesh into the scene and computes its bounds. `mesh` is left empty, also on failure.
lobe_result scenes_add_mesh(lobe_scene *scene, lobe_mesh *mesh, const lobe_host *host,
                            uint32_t *index);

/// `transform` is column-major; NULL: the identity.
lobe_result scenes_add_instance(lobe_scene *scene, uint32_t mesh, uint32_t material,
                                const float transform[16], const lobe_host *host);

/// Adds a mesh and one instance of it with the identity transform. `mesh` is left empty, also on
/// failure.
lobe_result scenes_place_mesh(lobe_scene *scene, lobe_mesh *mesh, uint32_t material,
                              const lobe_host *host);

lobe_result scenes_add_light(lobe_scene *scene, const lobe_light *light, const lobe_host *host);

/// Adds `count` lights.
lobe_result scenes_add_lights(lobe_scene *scene, const lobe_light *lights, size_t count,
                              const lobe_host *host);

/// Sets a perspective camera: its position, the point it looks at, and its vertical field of view
/// in degrees. Up is +Y.
void scenes_set_camera(lobe_scene *scene, const float eye[3], const float target[3], float degrees);

/// If there is neither a light nor an environment, adds the environment "sky", with a notice. Sets
/// `has_added_light`.
lobe_result scenes_add_missing_light(lobe_scene *scene, const lobe_host *host);

/// Sets the scene's bounds from those of its meshes. LOBE_ERROR_LIMIT, with the bounds unchanged,
/// if they are too far out.
lobe_result scenes_set_bounds(lobe_scene *scene, const lobe_host *host);

/// The last step: sets the scene's bounds and adds a missing camera, which frames them, and, unless
/// `own_light_only`, missing light, each with a notice. A scene without instances stays dark,
/// without a notice. Errors: LOBE_ERROR_LIMIT (bounds too far out), _OUT_OF_MEMORY.
lobe_result scenes_complete(lobe_scene *scene, bool own_light_only, const lobe_host *host);

#endif
