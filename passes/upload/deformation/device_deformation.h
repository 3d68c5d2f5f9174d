#ifndef PASSES_UPLOAD_DEVICE_DEFORMATION_H
#define PASSES_UPLOAD_DEVICE_DEFORMATION_H

#include <lobe/graph.h>
#include <lobe/scene.h>

/// An array of the device.
typedef struct stored_array {
    lobe_buffer *buffer; ///< NULL: none
    size_t size;         ///< bytes
} stored_array;

/// What a deformation has besides its pose, on the device.
typedef struct device_deformation {
    stored_array influences, first_deltas, deltas;
} device_deformation;

/// Stores what the mesh's deformation has, in the buffers it has or in new ones; frees them if the
/// mesh has none. The mesh must have been checked.
lobe_result passes_device_deformation_upload(lobe_graph *graph, const lobe_mesh *mesh,
                                             device_deformation *deformation);

void passes_device_deformation_destroy(device_deformation *deformation);

#endif
