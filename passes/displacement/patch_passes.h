#ifndef PASSES_DISPLACEMENT_PATCH_PASSES_H
#define PASSES_DISPLACEMENT_PATCH_PASSES_H

#include "passes/displacement/displaced_mesh.h"
#include "passes/displacement/height_bounds.h"
#include "passes/displacement/patch_layout.h"

/// What the passes of a displaced instance read.
typedef struct displaced_surface {
    size_t instance;
    const displaced_mesh *mesh;  ///< posed
    const lobe_texture_use *use; ///< of the height map
    const patch_layout *layout;
    double relief;          ///< of height 1, the object's lengths
    uint32_t width, height; ///< texels of the height map
    lobe_resource heights, height_levels;
    uint32_t levels;        ///< with level 0
    lobe_resource measures; ///< of the mesh's charts
    height_bounds bounds;   ///< of the heights
    double spacing;         ///< of vertices, pixels
} displaced_surface;

/// Adds the passes that cut an instance into patches, choose how finely each is divided for the
/// camera, and write its vertices and triangles.
displaced_geometry passes_displace_patches(const filter_context *context,
                                           const displaced_surface *surface);

#endif
