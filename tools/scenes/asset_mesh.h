#ifndef TOOLS_SCENES_ASSET_MESH_H
#define TOOLS_SCENES_ASSET_MESH_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// A mesh from a folder of assets.
typedef struct asset_mesh {
    const char *scene; ///< for messages
    const char *file;  ///< in the folder: "models/dragon.ply"
    double height;     ///< metres, to which the mesh is scaled
    double tile;       ///< metres of surface that one repetition of a map covers
} asset_mesh;

/// Reads the mesh, PLY or JavaScript (see tools/scenes/mesh_formats.h), compressed with gzip or
/// not, recognised by its content. Places it on y = 0 with the middle of its bounds above the
/// origin, and gives it texture coordinates (see tools/scenes/box_projection.h). `assets`: the
/// folder; NULL: none. On failure `mesh` is empty. Errors: LOBE_ERROR_NOT_FOUND (no folder, or the
/// file is not in it; the message says how to give it), _READ, _MALFORMED, _UNSUPPORTED, _LIMIT,
/// _OUT_OF_MEMORY.
lobe_result asset_mesh_load(const asset_mesh *wanted, const char *assets, const lobe_host *host,
                            lobe_mesh *mesh);

#endif
