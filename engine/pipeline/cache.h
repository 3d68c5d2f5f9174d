#ifndef ENGINE_PIPELINE_CACHE_H
#define ENGINE_PIPELINE_CACHE_H

#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

/// Compiled pipelines, kept in a file between runs.
typedef struct engine_pipeline_cache {
    VkPipelineCache vulkan;
    char *file;        ///< NULL: none
    uint64_t checksum; ///< of the file's content; 0: unusable
} engine_pipeline_cache;

/// Starts with the content of the file if that is intact and from this driver, else empty. A
/// missing or unusable file is not an error.
lobe_result engine_pipeline_cache_create(lobe_device *device, const char *file,
                                         engine_pipeline_cache *cache);
/// Writes the file if its content would change (logs a warning if that fails), then frees
/// everything.
void engine_pipeline_cache_destroy(lobe_device *device, engine_pipeline_cache *cache);

#endif
