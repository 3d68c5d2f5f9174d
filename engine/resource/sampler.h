#ifndef ENGINE_RESOURCE_SAMPLER_H
#define ENGINE_RESOURCE_SAMPLER_H

#include <vulkan/vulkan.h>

#include <lobe/graph.h>

/// Samplers by their settings. All zero: none.
typedef struct engine_sampler_cache {
    struct engine_cached_sampler *samplers;
} engine_sampler_cache;

lobe_result engine_sampler_cache_get(lobe_device *device, engine_sampler_cache *cache,
                                     const lobe_sampler *settings, VkSampler *sampler);
void engine_sampler_cache_destroy(lobe_device *device, engine_sampler_cache *cache);

#endif
