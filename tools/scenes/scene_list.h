#ifndef TOOLS_SCENES_SCENE_LIST_H
#define TOOLS_SCENES_SCENE_LIST_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// The scenes that the program knows by name: the library's built-in ones, and its own: some have
/// meshes from a folder of assets, others maps that change with time.

typedef struct listed_scene {
    const char *name;
    const char *summary; ///< one line
    bool needs_assets;   ///< its mesh is read from a file in the folder of assets
    const char *filter;  ///< that shows what the scene is about; NULL: any does
} listed_scene;

size_t scene_list_count(void);

/// `index` < scene_list_count().
listed_scene scene_list_get(size_t index);

/// Whether there is a scene of this name that needs assets.
bool scene_list_needs_assets(const char *name);

/// The filter to draw a scene with where the user names none: that of a listed scene, or "moments".
/// `name` may be NULL.
const char *scene_list_filter(const char *name);

/// Opens a listed scene, or a file or folder as lobe_scene_open does. `assets`: the folder that
/// holds models/npm_bunny.js and models/npm_dragon_vrip_res3.ply.gz, the meshes of the scenes that
/// need assets; NULL: none, and those scenes are LOBE_ERROR_NOT_FOUND. `own_light_only`: see
/// lobe_scene_open_parameters.
lobe_result scene_list_open(const char *name, const char *assets, bool own_light_only,
                            const lobe_host *host, lobe_scene **scene);

#endif
