#ifndef SCENES_GLTF_CONTAINER_H
#define SCENES_GLTF_CONTAINER_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// The bytes of a .gltf or .glb file, and where in them the JSON text is.
typedef struct gltf_container {
    char *bytes;
    size_t size; ///< without what follows the last part that is read
    const char *json;
    size_t json_size;
    bool binary; ///< GLB
} gltf_container;

/// Finds the JSON text; for GLB checks header and chunks, and shortens what the header says to
/// the two chunks that a reader needs. `bytes` and `size` are set by the caller.
/// Errors: LOBE_ERROR_MALFORMED, LOBE_ERROR_UNSUPPORTED (a GLB version other than 2).
lobe_result scenes_gltf_container_open(gltf_container *container, const char *path,
                                       const lobe_host *host);

#endif
