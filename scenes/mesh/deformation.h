#ifndef SCENES_MESH_DEFORMATION_H
#define SCENES_MESH_DEFORMATION_H

#include <stdbool.h>

#include <lobe/scene.h>

/// Frees everything and clears the pointer. NULL is allowed.
void scenes_deformation_free(lobe_deformation **deformation);

/// Appends what the deformation, if the mesh has one, says of copies of vertices: of the i-th, that
/// of vertex `origins[i]`. The mesh's own vertices are appended by the caller. False, with nothing
/// changed that counts, if memory runs out.
bool scenes_deformation_copy_vertices(lobe_mesh *mesh, const uint32_t *origins, size_t count);

/// Adds a delta to each of `vertices`, after those that it has; a vertex may occur several times.
/// False, with nothing changed, if memory ends.
bool scenes_deformation_add_deltas(lobe_mesh *mesh, const lobe_morph_delta *added,
                                   const uint32_t *vertices, size_t count,
                                   const lobe_allocator *allocator);

#endif
