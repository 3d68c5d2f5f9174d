#ifndef SCENES_GLTF_POINTER_POINTER_NODES_H
#define SCENES_GLTF_POINTER_POINTER_NODES_H

#include "scenes/gltf/container.h"

/// Targets of animations that are pointers (KHR_animation_pointer) have no node, and tinygltf drops
/// channels whose target has none: it is given one in the text.

/// Where members of such targets begin in the JSON text. Release `places`.
typedef struct pointer_nodes {
    size_t *places;
    size_t count;
} pointer_nodes;

/// Adds a place, after all others. LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_pointer_nodes_add(pointer_nodes *nodes, size_t place, const char *path,
                                     const lobe_host *host);

/// Inserts the nodes. Errors as of scenes_gltf_container_insert.
lobe_result scenes_pointer_nodes_insert(const pointer_nodes *nodes, gltf_container *container,
                                        const char *path, const lobe_host *host);

#endif
