#ifndef ENGINE_PIPELINE_CACHE_H
#define ENGINE_PIPELINE_CACHE_H

#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

/// Compiled pipelines, kept in a file between runs.
typedef struct engine_pipeline_cache {
    VkPipelineCache vulkan;
    char *file;        ///< NULL: none
    uint64_t checksum; ///< of what the file holds; 0: nothing of use
} engine_pipeline_cache;

/// Starts from the file where it belongs to this driver and is whole; else empty. A file that is
/// missing or of no use is no failure.
lobe_result engine_pipeline_cache_create(lobe_device *device, const char *file,
                                         engine_pipeline_cache *cache);
/// Writes the file where its content would change (a warning where that fails), then frees all.
void engine_pipeline_cache_destroy(lobe_device *device, engine_pipeline_cache *cache);

#endif
