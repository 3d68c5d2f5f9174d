#ifndef SCENES_GLTF_POINTER_ANIMATION_POINTER_H
#define SCENES_GLTF_POINTER_ANIMATION_POINTER_H

#include "scenes/gltf/gltf.h"

/// Channels of KHR_animation_pointer: what their pointers move.

typedef struct animation_target {
    lobe_channel_path path;
    lobe_posed_map map; ///< for LOBE_CHANNEL_MAP_...
    int node;           ///< of the file, if the path is one of a node
    uint32_t index;     ///< else: into the rig's materials or light_numbers
} animation_target;

/// Resolves a pointer. `*known`: false if lobe does not move that property. False, with the cause,
/// if it points to what the file does not have.
bool scenes_gltf_resolve_pointer(const gltf_import *import, const char *pointer,
                                 animation_target *target, bool *known, char *cause, size_t size);

/// Gives the rig the numbers at rest of all materials and lights, by their indices in the file, if
/// an animation has a pointer. LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_gltf_begin_numbers(gltf_import *import);
/// Tells the rig which materials of the file are in the scene.
void scenes_gltf_end_numbers(gltf_import *import);

#endif
