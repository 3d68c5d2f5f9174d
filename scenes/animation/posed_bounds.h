#ifndef SCENES_ANIMATION_POSED_BOUNDS_H
#define SCENES_ANIMATION_POSED_BOUNDS_H

#include <lobe/host.h>
#include <lobe/scene.h>

/// Finds the boxes that bounds of poses are made of, from the mesh's vertices and deformation.
/// LOBE_ERROR_OUT_OF_MEMORY, logged.
lobe_result scenes_posed_bounds_measure(const lobe_mesh *mesh, lobe_posed_mesh *posed,
                                        const lobe_host *host);

/// Sets the bounds of a mesh in the pose that its deformation has. They contain every vertex: a
/// vertex is a mean of where its joints take it, and each joint's box contains it. Left as they are
/// where `posed` has no boxes.
void scenes_posed_bounds_set(const lobe_posed_mesh *posed, lobe_mesh *mesh);

#endif
