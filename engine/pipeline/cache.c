#include "engine/pipeline/cache.h"

#include <string.h>

#include <lobe/file.h>

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"

/// Precedes Vulkan's own data. Drivers may crash on damaged data, so lobe checks it.
typedef struct cache_header {
    char magic[8];
    uint64_t size;     ///< bytes that follow
    uint64_t checksum; ///< of them
} cache_header;

static const char magic[8] = "lobepc1";

/// Fowler, Noll, Vo 1991, FNV-1a, 64 bits.
static uint64_t checksum_of(const uint8_t *data, size_t size) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ data[i]) * 0x100000001b3u;
    return hash;
}

/// Whether Vulkan's data has the header of this driver and device.
static bool belongs_to(const lobe_device *device, const uint8_t *data, size_t size) {
    VkPipelineCacheHeaderVersionOne mark;
    VkPhysicalDeviceProperties properties;
    if (size < sizeof mark)
        return false;
    memcpy(&mark, data, sizeof mark);
    device->instance.api.vkGetPhysicalDeviceProperties(device->physical, &properties);
    return mark.headerSize == sizeof mark &&
           mark.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           mark.vendorID == properties.vendorID && mark.deviceID == properties.deviceID &&
           !memcmp(mark.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE);
}

static bool is_whole(const cache_header *header, const uint8_t *data, size_t size) {
    return !memcmp(header->magic, magic, sizeof magic) && header->size == size &&
           header->checksum == checksum_of(data, size);
}

/// Returns Vulkan's part of a file's content, or NULL if it is unusable.
static const uint8_t *usable_part(const lobe_device *device, const uint8_t *content, size_t size,
                                  cache_header *header) {
    if (size < sizeof *header)
        return NULL;
    memcpy(header, content, sizeof *header);
    const uint8_t *data = content + sizeof *header;
    size -= sizeof *header;
    return is_whole(header, data, size) && belongs_to(device, data, size) ? data : NULL;
}

static lobe_result create_cache(lobe_device *device, const uint8_t *data, size_t size,
                                engine_pipeline_cache *cache) {
    const VkPipelineCacheCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
        .initialDataSize = size,
        .pInitialData = data,
    };
    return VULKAN_CHECK(&device->host,
                        device->api.vkCreatePipelineCache(device->vulkan, &create,
                                                          device->callbacks, &cache->vulkan),
                        "pipeline cache");
}

lobe_result engine_pipeline_cache_create(lobe_device *device, const char *file,
                                         engine_pipeline_cache *cache) {
    *cache = (engine_pipeline_cache){0};
    if (!file)
        return create_cache(device, NULL, 0, cache);
    cache->file = lobe_copy_text(device->host.allocator, file);
    if (!cache->file)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "pipeline cache: no memory");
    const lobe_host silent = {.allocator = device->host.allocator};
    uint8_t *content = NULL;
    size_t size = 0;
    const bool found = lobe_file_read(file, NULL, &silent, &content, &size) == LOBE_OK;
    cache_header header = {0};
    const uint8_t *data = found ? usable_part(device, content, size, &header) : NULL;
    if (found && !data)
        lobe_host_log(&device->host, LOBE_LOG_DEBUG,
                      "pipeline cache '%s' is damaged or from another driver; replacing it", file);
    cache->checksum = data ? header.checksum : 0;
    const lobe_result result = create_cache(device, data, data ? header.size : 0, cache);
    lobe_release(content);
    return result;
}

/// Returns the file's new content, which the caller frees with lobe_release; NULL if there is none
/// or memory runs out.
static uint8_t *content_of(lobe_device *device, VkPipelineCache cache, size_t *size,
                           uint64_t *checksum) {
    size_t data_size = 0;
    if (device->api.vkGetPipelineCacheData(device->vulkan, cache, &data_size, NULL) != VK_SUCCESS)
        return NULL;
    uint8_t *content = lobe_allocate(device->host.allocator, 1, sizeof(cache_header) + data_size);
    if (!content)
        return NULL;
    uint8_t *data = content + sizeof(cache_header);
    if (device->api.vkGetPipelineCacheData(device->vulkan, cache, &data_size, data) != VK_SUCCESS) {
        lobe_release(content);
        return NULL;
    }
    cache_header header = {.size = data_size, .checksum = checksum_of(data, data_size)};
    memcpy(header.magic, magic, sizeof magic);
    memcpy(content, &header, sizeof header);
    *size = sizeof header + data_size;
    *checksum = header.checksum;
    return content;
}

static void save(lobe_device *device, const engine_pipeline_cache *cache) {
    const lobe_host silent = {.allocator = device->host.allocator};
    size_t size = 0;
    uint64_t checksum = 0;
    uint8_t *content = content_of(device, cache->vulkan, &size, &checksum);
    if (content && checksum != cache->checksum &&
        lobe_file_write(cache->file, content, size, &silent) != LOBE_OK)
        lobe_host_log(&device->host, LOBE_LOG_WARNING, "pipeline cache '%s' cannot be written",
                      cache->file);
    lobe_release(content);
}

void engine_pipeline_cache_destroy(lobe_device *device, engine_pipeline_cache *cache) {
    if (cache->file && cache->vulkan)
        save(device, cache);
    device->api.vkDestroyPipelineCache(device->vulkan, cache->vulkan, device->callbacks);
    lobe_release(cache->file);
    *cache = (engine_pipeline_cache){0};
}
