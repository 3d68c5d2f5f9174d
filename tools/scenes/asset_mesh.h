#ifndef TOOLS_SCENES_ASSET_MESH_H
#define TOOLS_SCENES_ASSET_MESH_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// A mesh that a built-in scene takes from a folder of assets.
typedef struct asset_mesh {
    const char *scene; ///< for messages
    const char *file;  ///< in the folder: "models/dragon.ply"
    double height;     ///< it is scaled to, metres
    double tile;       ///< metres of the surface that one repetition of a map covers
} asset_mesh;

/// Reads the mesh, PLY or JavaScript (see tools/scenes/ply.h, tools/scenes/javascript_mesh.h),
/// packed by gzip or not, told apart by content. It comes to stand on y = 0 with the middle of its
/// bounds above the origin, and gets texture coordinates by tools/scenes/box_projection.h.
/// `assets`: the folder; NULL: none. On failure `mesh` is empty. Errors: LOBE_ERROR_NOT_FOUND (no
/// folder, or it lacks the file; the line says how to give it), _READ, _MALFORMED, _UNSUPPORTED,
/// _LIMIT, _OUT_OF_MEMORY.
lobe_result asset_mesh_load(const asset_mesh *wanted, const char *assets, const lobe_host *host,
                            lobe_mesh *mesh);

#endif
