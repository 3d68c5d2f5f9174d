#ifndef PASSES_UPLOAD_DEVICE_MESH_H
#define PASSES_UPLOAD_DEVICE_MESH_H

#include "passes/upload/device_scene.h"

/// The vertices of a mesh in this frame, a buffer of struct vertex: in its pose, if it has one.
lobe_resource passes_device_mesh_import(lobe_graph *graph, const device_scene *scene,
                                        uint32_t mesh);
/// The same of the previous frame, where the host gives them; else as in this frame.
lobe_resource passes_device_mesh_import_previous(lobe_graph *graph, const device_scene *scene,
                                                 uint32_t mesh);

/// The same before they are deformed: those that the host gives, or the scene's.
lobe_resource passes_device_mesh_import_base(lobe_graph *graph, const device_scene *scene,
                                             uint32_t mesh);

#endif
