#include "engine/resource/sampler.h"

#include <math.h>

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"

typedef struct engine_cached_sampler {
    struct engine_cached_sampler *next;
    lobe_sampler settings;
    VkSampler sampler;
} engine_cached_sampler;

static VkFilter filter_of(lobe_filter_mode mode) {
    return mode == LOBE_SAMPLE_LINEAR ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
}

static VkSamplerMipmapMode mipmap_mode_of(lobe_filter_mode mode) {
    return mode == LOBE_SAMPLE_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                      : VK_SAMPLER_MIPMAP_MODE_NEAREST;
}

static VkSamplerAddressMode address_mode_of(lobe_wrap_mode mode) {
    switch (mode) {
    case LOBE_WRAP_MIRROR:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case LOBE_WRAP_CLAMP:
        return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    default:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    }
}

/// The requested anisotropy, limited to what the device supports; 0: off.
static float offered_anisotropy(const lobe_device *device, float asked) {
    if (!(asked > 1) || !device->features.core.features.samplerAnisotropy)
        return 0;
    return fminf(asked, device->limits.maxSamplerAnisotropy);
}

static bool same(const lobe_sampler *first, const lobe_sampler *second) {
    return first->texels == second->texels && first->levels == second->levels &&
           first->wrap_u == second->wrap_u && first->wrap_v == second->wrap_v &&
           first->maximum_anisotropy == second->maximum_anisotropy;
}

static lobe_result create(lobe_device *device, const lobe_sampler *settings, VkSampler *sampler) {
    const VkSamplerCreateInfo information = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter_of(settings->texels),
        .minFilter = filter_of(settings->texels),
        .mipmapMode = mipmap_mode_of(settings->levels),
        .addressModeU = address_mode_of(settings->wrap_u),
        .addressModeV = address_mode_of(settings->wrap_v),
        .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
        .anisotropyEnable = settings->maximum_anisotropy > 0,
        .maxAnisotropy = settings->maximum_anisotropy,
        .maxLod = VK_LOD_CLAMP_NONE,
    };
    return VULKAN_CHECK(
        &device->host,
        device->api.vkCreateSampler(device->vulkan, &information, device->callbacks, sampler),
        "sampler");
}

lobe_result engine_sampler_cache_get(lobe_device *device, engine_sampler_cache *cache,
                                     const lobe_sampler *settings, VkSampler *sampler) {
    lobe_sampler offered = *settings;
    offered.maximum_anisotropy = offered_anisotropy(device, settings->maximum_anisotropy);
    for (engine_cached_sampler *known = cache->samplers; known; known = known->next)
        if (same(&known->settings, &offered)) {
            *sampler = known->sampler;
            return LOBE_OK;
        }
    engine_cached_sampler *added = lobe_allocate(device->host.allocator, 1, sizeof *added);
    if (!added)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "sampler: out of memory");
    added->settings = offered;
    const lobe_result result = create(device, &offered, &added->sampler);
    if (result != LOBE_OK) {
        lobe_release(added);
        return result;
    }
    added->next = cache->samplers;
    cache->samplers = added;
    *sampler = added->sampler;
    return LOBE_OK;
}

void engine_sampler_cache_destroy(lobe_device *device, engine_sampler_cache *cache) {
    for (engine_cached_sampler *sampler = cache->samplers, *next; sampler; sampler = next) {
        next = sampler->next;
        device->api.vkDestroySampler(device->vulkan, sampler->sampler, device->callbacks);
        lobe_release(sampler);
    }
    cache->samplers = NULL;
}
