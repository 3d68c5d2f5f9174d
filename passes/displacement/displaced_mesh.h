#ifndef PASSES_DISPLACEMENT_DISPLACED_MESH_H
#define PASSES_DISPLACEMENT_DISPLACED_MESH_H

#include "passes/context/filter.h"

/// The welded copy of a mesh on the device.
typedef struct displaced_mesh {
    uint32_t version; ///< of the mesh that it is a copy of (mesh_measures); 0: none
    uint32_t point_count, chart_count;
    lobe_buffer *triangles, *edges, *charts, *points, *pairs, *corners;
    lobe_resource posed;        ///< of this frame: struct posed_point
    lobe_resource posed_before; ///< of the previous frame
} displaced_mesh;

/// Makes or renews the copy, if the mesh has changed. Logs nothing but what the device refuses.
lobe_result passes_displaced_mesh_update(const device_scene *scene, uint32_t index,
                                         displaced_mesh *mesh);
void passes_displaced_mesh_destroy(displaced_mesh *mesh);

/// Adds the pass that poses the points, unless this frame has it already.
void passes_displaced_mesh_pose(const filter_context *context, uint32_t index,
                                displaced_mesh *mesh);
/// The same of the previous frame, for a mesh that has vertices of it.
void passes_displaced_mesh_pose_before(const filter_context *context, uint32_t index,
                                       displaced_mesh *mesh);
/// Adds the pass that measures how a map lies on the mesh's charts; returns a buffer of struct
/// chart_measure. `number`: of the instance that has the map, for a name.
lobe_resource passes_displaced_mesh_measure(const filter_context *context, uint32_t index,
                                            const displaced_mesh *mesh, const lobe_texture_use *use,
                                            size_t number);

#endif
