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

/// The buffers of an instance in a frame.
typedef struct patch_buffers {
    lobe_resource constants, sizes, bins, offsets, arguments, vertices, triangles;
    uint32_t vertex_room; ///< of `vertices`, after the first
} patch_buffers;

/// Adds the passes that cut an instance into patches, choose how finely each is divided for the
/// camera, and write its vertices and triangles.
patch_buffers passes_displace_patches(const filter_context *context,
                                      const displaced_surface *surface);
/// Adds the pass that writes where these vertices were when the mesh had its previous pose
/// (`posed_before`); returns a buffer like theirs.
lobe_resource passes_displace_before(const filter_context *context,
                                     const displaced_surface *surface,
                                     const patch_buffers *buffers);

#endif
