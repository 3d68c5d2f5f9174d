#ifndef SCENES_MESH_WELD_H
#define SCENES_MESH_WELD_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/scene.h>

/// Finds the vertices that differ in nothing but number: of equal position, normal, set `set` of
/// texture coordinates and, with `tangents`, tangent. `welded[i]` becomes the first vertex equal to
/// vertex i. False if memory ends.
bool scenes_mesh_weld(const lobe_allocator *allocator, const lobe_mesh *mesh, uint32_t set,
                      bool tangents, uint32_t *welded);

#endif
