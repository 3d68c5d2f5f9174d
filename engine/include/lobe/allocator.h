#ifndef LOBE_ALLOCATOR_H
#define LOBE_ALLOCATOR_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Where a host gives lobe memory. It travels with the log (lobe_host.allocator), which every call
/// is given that may need memory: what takes memory can fail, and what fails says so. All that a
/// call makes comes from there; all that is made on a device (renderers, graphs, textures, frames)
/// comes from where the device does.
///
/// Not lobe's own, and so not from here: what the Vulkan driver takes (see allocation_callbacks of
/// lobe_vulkan_device), what SPIRV-Cross takes while it looks at a shader, and tinygltf, libjpeg
/// and OpenEXR while a file is open, for they cannot be told whose memory to take; and what the C
/// library takes while it lists a folder or sorts. libpng and zlib take theirs here.
///
/// Both functions may be called from several threads at once. The structure itself is not copied:
/// it must outlive all that was made with it.
typedef struct lobe_allocator {
    /// Gives `size` bytes (above 0), aligned to 16 bytes; their content does not matter. NULL where
    /// there are none: the call fails with LOBE_ERROR_OUT_OF_MEMORY.
    void *(*allocate)(void *user, size_t size);
    /// Takes back what `allocate` gave, with the size it was asked for. `memory` is never NULL.
    void (*release)(void *user, void *memory, size_t size);
    void *user; ///< handed to both
} lobe_allocator;

/// Memory that lobe itself may free: for hosts that fill a lobe_scene, a lobe_environment or a
/// lobe_image of their own and leave it to lobe to destroy. `count` elements of `size` bytes,
/// zeroed, aligned to 16 bytes. A valid pointer where that is 0 bytes; NULL without memory.
/// `allocator` NULL: the C library's.
void *lobe_allocate(const lobe_allocator *allocator, size_t count, size_t size);
/// Makes what lobe_allocate gave larger or smaller; `memory` may be elsewhere afterwards. What is
/// added is not zeroed. `allocator` is that of the memory, or of new one where `memory` is NULL.
/// NULL without memory: the old is then as it was.
void *lobe_reallocate(const lobe_allocator *allocator, void *memory, size_t count, size_t size);
/// Copies a text. NULL without memory.
char *lobe_copy_text(const lobe_allocator *allocator, const char *text);
/// Frees what the three above gave, and whatever a function of lobe leaves to its caller to
/// release: it goes back to the allocator it came from, which it remembers. NULL is fine.
void lobe_release(void *memory);

#ifdef __cplusplus
}
#endif

#endif
