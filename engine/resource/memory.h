#ifndef ENGINE_RESOURCE_MEMORY_H
#define ENGINE_RESOURCE_MEMORY_H

#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

/// Device memory, allocated from Vulkan in blocks and handed out in pieces. Thread-safe.
typedef struct engine_memory engine_memory;
typedef struct engine_memory_block engine_memory_block;

typedef enum engine_memory_place {
    ENGINE_MEMORY_DEVICE,    ///< fastest for the device; not accessible to the host
    ENGINE_MEMORY_UPLOAD,    ///< mapped and coherent, written by the host once
    ENGINE_MEMORY_READ_BACK, ///< mapped and coherent, cached where possible, read by the host
} engine_memory_place;

typedef struct engine_memory_request {
    const char *name; ///< for the error line; NULL: none, because the caller has another way
    VkMemoryRequirements requirements;
    engine_memory_place place;
    /// True for buffers and linear images, false for optimally tiled images: the two never share a
    /// page of bufferImageGranularity. A request that will hold both must keep them that far apart.
    bool linear;
} engine_memory_request;

/// A piece of a block. All zero: none.
typedef struct engine_allocation {
    VkDeviceMemory memory;
    VkDeviceSize offset; ///< bytes from the start of `memory`
    VkDeviceSize size;
    void *mapped; ///< host address of `offset`; NULL in ENGINE_MEMORY_DEVICE
    engine_memory_block *block;
} engine_allocation;

/// `limit`: most bytes to take from Vulkan; 0: none. The device must outlive the memory.
lobe_result engine_memory_create(lobe_device *device, uint64_t limit, engine_memory **memory);
/// All allocations must have been freed.
void engine_memory_destroy(engine_memory **memory);

/// Errors: LOBE_ERROR_OUT_OF_DEVICE_MEMORY (device, its budget or the limit is exhausted),
/// LOBE_ERROR_OUT_OF_MEMORY. On failure `*allocation` is all zero.
lobe_result engine_memory_allocate(engine_memory *memory, const engine_memory_request *request,
                                   engine_allocation *allocation);
/// Zeroes the allocation; an all-zero one is allowed.
void engine_memory_free(engine_memory *memory, engine_allocation *allocation);

void engine_memory_query(engine_memory *memory, lobe_device_memory *information);
void engine_memory_reset_peak(engine_memory *memory);

#endif
