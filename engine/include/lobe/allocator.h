#ifndef LOBE_ALLOCATOR_H
#define LOBE_ALLOCATOR_H

#include <stddef.h>

#include <lobe/api.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Host memory for lobe. It is passed as a member of lobe_host, which every call that may allocate
/// takes. Everything a call creates is allocated from there; everything created on a device
/// (renderers, graphs, textures, frames) uses the allocator of the device.
///
/// These allocations do not come from here: those of the Vulkan driver (see allocation_callbacks of
/// lobe_vulkan_device); those of SPIRV-Cross during reflection, and of tinygltf, libjpeg and
/// OpenEXR while a file is open, as these libraries take no allocator; and those of the C library
/// while it lists a folder or sorts. libpng and zlib do allocate from here.
///
/// Both functions may be called from several threads at once. The structure is not copied: it must
/// outlive everything that was allocated with it.
typedef struct lobe_allocator {
    /// Returns `size` bytes (above 0), aligned to 16 bytes, with any content. On NULL, the call
    /// into lobe fails with LOBE_ERROR_OUT_OF_MEMORY.
    void *(*allocate)(void *user, size_t size);
    /// Frees what `allocate` returned; `size` is the size that was asked for. `memory` is never
    /// NULL.
    void (*release)(void *user, void *memory, size_t size);
    void *user; ///< passed to both
} lobe_allocator;

/// Allocates memory that lobe can free: for hosts that fill in a lobe_scene, a lobe_environment or
/// a lobe_image themselves and let lobe destroy it. `count` elements of `size` bytes, zeroed,
/// aligned to 16 bytes. A valid pointer even for 0 bytes; NULL if out of memory. `allocator` NULL:
/// the C library's.
LOBE_API void *lobe_allocate(const lobe_allocator *allocator, size_t count, size_t size);
/// Resizes what lobe_allocate returned; the memory may move. Added bytes are not zeroed.
/// `allocator` is only used if `memory` is NULL. Returns NULL if out of memory; the old memory is
/// then unchanged.
LOBE_API void *lobe_reallocate(const lobe_allocator *allocator, void *memory, size_t count,
                               size_t size);
/// Copies a string. NULL if out of memory.
LOBE_API char *lobe_copy_text(const lobe_allocator *allocator, const char *text);
/// Frees what the three functions above returned, and whatever else lobe leaves to the caller to
/// release. The memory remembers its allocator. NULL is allowed.
LOBE_API void lobe_release(void *memory);

#ifdef __cplusplus
}
#endif

#endif
