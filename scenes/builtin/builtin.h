#ifndef SCENES_BUILTIN_H
#define SCENES_BUILTIN_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

#include "scenes/builtin/asset_mesh.h"

/// The scenes made by code. Each is one file, scenes/builtin_<name>.c, and one row of the table
/// in scenes/builtin/builtin.c. They use no random source but scenes/builtin/random.h, and of libm
/// only what IEEE 754 defines to the last bit (sqrt, floor, fmin): every machine makes the same
/// bytes.

typedef struct builtin_scene {
    lobe_builtin_scene description;
    /// Makes a completed scene. On failure `*scene` is NULL. One of the two, as
    /// description.needs_assets says.
    lobe_result (*build)(const lobe_host *host, lobe_scene **scene);
    lobe_result (*build_from_assets)(const char *assets, const lobe_host *host, lobe_scene **scene);
} builtin_scene;

/// NULL where there is none of that name; not an error, nothing is logged.
const builtin_scene *scenes_builtin_find(const char *name);

/// One step of building: adds its part to the scene.
typedef lobe_result (*builtin_step)(lobe_scene *scene, const lobe_host *host);

/// Runs the steps, ended by NULL, on an empty scene, and completes it.
lobe_result scenes_builtin_assemble(const char *name, const builtin_step *steps,
                                    const lobe_host *host, lobe_scene **scene);

/// The same for a scene that shows one mesh of a folder of assets (may be NULL): the mesh is read
/// first and gets the first material that the steps add. Errors: as for scenes_asset_mesh_load.
lobe_result scenes_builtin_assemble_asset(const asset_mesh *wanted, const char *assets,
                                          const builtin_step *steps, const lobe_host *host,
                                          lobe_scene **scene);

/// A map whose texels are told one by one.
typedef struct builtin_map {
    const char *name;
    lobe_format format;
    uint32_t width, height; ///< texels
    void (*fill)(uint32_t column, uint32_t row, void *texel);
} builtin_map;

lobe_result scenes_builtin_add_map(lobe_scene *scene, const builtin_map *map, const lobe_host *host,
                                   int32_t *index);

/// Adds a microfacet material (GGX) of three maps: normals, base colours, and roughness in green
/// with metal in blue.
lobe_result scenes_builtin_add_metal_rough(lobe_scene *scene, const char *name,
                                           const builtin_map *normals, const builtin_map *colours,
                                           const builtin_map *roughness, const lobe_host *host);

lobe_result scenes_builtin_checkerboard(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_bumps(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_tablecloth(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_pillow(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_hall(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_bunny(const char *assets, const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_dragon(const char *assets, const lobe_host *host, lobe_scene **scene);

#endif
