#ifndef PASSES_DISPLACEMENT_PATCH_LAYOUT_H
#define PASSES_DISPLACEMENT_PATCH_LAYOUT_H

#include <lobe/scene.h>

/// How a height map lies on a mesh, and how the mesh is cut into patches for it.
typedef struct patch_layout {
    /// Length over which the map's u grows by 1, the object's: the mean over the mesh's area. 0:
    /// the map covers no area.
    double unit;
    uint32_t depth;   ///< patches of a triangle: 4^depth
    uint32_t patches; ///< of all triangles
} patch_layout;

/// Triangles of a mesh that can be displaced.
enum { PATCH_MOST_TRIANGLES = 1 << 19 };

/// Of a mesh with the texture coordinates that `use` says, at rest. Triangles are cut until a patch
/// has no more than a texel for each of its smallest triangles, as long as there are no more than
/// 65,536 patches.
patch_layout passes_patch_layout(const lobe_mesh *mesh, const lobe_texture_use *use, uint32_t width,
                                 uint32_t height);

#endif
