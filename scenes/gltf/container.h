#ifndef SCENES_GLTF_CONTAINER_H
#define SCENES_GLTF_CONTAINER_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// The bytes of a .gltf or .glb file, and the position of the JSON text in them.
typedef struct gltf_container {
    char *bytes;
    size_t size; ///< up to the end of the last part that is read
    const char *json;
    size_t json_size;
    bool binary; ///< GLB
} gltf_container;

/// Finds the JSON text. For GLB, checks the header and chunks, and shortens the sizes in the header
/// to the two chunks that a reader needs. The caller sets `bytes` and `size`. Errors:
/// LOBE_ERROR_MALFORMED, LOBE_ERROR_UNSUPPORTED (a GLB version other than 2).
lobe_result scenes_gltf_container_open(gltf_container *container, const char *path,
                                       const lobe_host *host);

/// Puts a text into the JSON text, at each of some ascending places. `bytes` is replaced by other
/// memory of lobe_allocate. Errors: LOBE_ERROR_OUT_OF_MEMORY, LOBE_ERROR_LIMIT (GLB of 4 GiB).
lobe_result scenes_gltf_container_insert(gltf_container *container, const size_t *places,
                                         size_t count, const char *text, const char *path,
                                         const lobe_host *host);

#endif
