#include "engine/resource/memory.h"

#include <pthread.h>

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "engine/resource/range_allocator.h"

/// Each block of a kind of memory is as large as all others together, within these bounds: blocks
/// stay few, and a small scene takes little.
#define SMALLEST_BLOCK ((VkDeviceSize)1 << 20)
#define LARGEST_BLOCK  ((VkDeviceSize)32 << 20)

struct engine_memory_block {
    engine_memory_block *next;
    VkDeviceMemory memory;
    VkDeviceSize size;
    uint32_t type;
    bool linear;
    void *mapped;
    engine_range_allocator ranges;
};

struct engine_memory {
    lobe_device *device;
    uint64_t limit;        ///< limit on the bytes in blocks; 0: none
    pthread_mutex_t mutex; ///< protects everything below
    VkPhysicalDeviceMemoryProperties properties;
    VkDeviceSize granularity;        ///< bufferImageGranularity
    VkDeviceSize maximum_allocation; ///< bytes
    engine_memory_block *blocks;
    uint64_t allocated, used, peak;                  ///< bytes
    uint64_t allocated_of_heap[VK_MAX_MEMORY_HEAPS]; ///< bytes
};

lobe_result engine_memory_create(lobe_device *device, uint64_t limit, engine_memory **memory) {
    *memory = lobe_allocate(device->host.allocator, 1, sizeof **memory);
    if (!*memory)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "device memory: out of memory");
    (*memory)->device = device;
    (*memory)->limit = limit;
    pthread_mutex_init(&(*memory)->mutex, NULL);
    VkPhysicalDeviceVulkan11Properties maintenance = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
    };
    VkPhysicalDeviceProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
        .pNext = &maintenance,
    };
    device->instance.api.vkGetPhysicalDeviceProperties2(device->physical, &properties);
    device->instance.api.vkGetPhysicalDeviceMemoryProperties(device->physical,
                                                             &(*memory)->properties);
    (*memory)->granularity = properties.properties.limits.bufferImageGranularity;
    (*memory)->maximum_allocation = maintenance.maxMemoryAllocationSize;
    return LOBE_OK;
}

static void release_block(engine_memory *memory, engine_memory_block *block) {
    // Freeing unmaps.
    const lobe_device *device = memory->device;
    device->api.vkFreeMemory(device->vulkan, block->memory, device->callbacks);
    memory->allocated -= block->size;
    memory->allocated_of_heap[memory->properties.memoryTypes[block->type].heapIndex] -= block->size;
    engine_range_allocator_destroy(&block->ranges);
    lobe_release(block);
}

void engine_memory_destroy(engine_memory **memory) {
    if (!*memory)
        return;
    while ((*memory)->blocks) {
        engine_memory_block *block = (*memory)->blocks;
        (*memory)->blocks = block->next;
        release_block(*memory, block);
    }
    pthread_mutex_destroy(&(*memory)->mutex);
    lobe_release(*memory);
    *memory = NULL;
}

// ---------------------------------------------------------------------------------------------
// Which kind of memory

static VkMemoryPropertyFlags required_flags(engine_memory_place place) {
    return place == ENGINE_MEMORY_DEVICE
               ? 0
               : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}

static VkMemoryPropertyFlags preferred_flags(engine_memory_place place) {
    switch (place) {
    case ENGINE_MEMORY_DEVICE:
        return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    case ENGINE_MEMORY_READ_BACK:
        return VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    default:
        return 0;
    }
}

/// Vulkan lists faster types first, so the first that fits is the best; UINT32_MAX: none.
static uint32_t find_type_with(const engine_memory *memory, uint32_t types,
                               VkMemoryPropertyFlags flags) {
    for (uint32_t i = 0; i < memory->properties.memoryTypeCount; i++)
        if ((types & 1u << i) && (memory->properties.memoryTypes[i].propertyFlags & flags) == flags)
            return i;
    return UINT32_MAX;
}

static uint32_t find_type(const engine_memory *memory, const engine_memory_request *request) {
    const uint32_t types = request->requirements.memoryTypeBits;
    const VkMemoryPropertyFlags required = required_flags(request->place);
    const uint32_t best = find_type_with(memory, types, required | preferred_flags(request->place));
    return best != UINT32_MAX ? best : find_type_with(memory, types, required);
}

// ---------------------------------------------------------------------------------------------
// How much is available

static uint64_t subtract(uint64_t from, uint64_t amount) {
    return from > amount ? from - amount : 0;
}

/// Bytes that this process may still allocate from a heap.
static uint64_t heap_room(const engine_memory *memory, uint32_t heap) {
    if (!memory->device->memory_budget)
        return subtract(memory->properties.memoryHeaps[heap].size, memory->allocated_of_heap[heap]);
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT,
    };
    VkPhysicalDeviceMemoryProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2,
        .pNext = &budget,
    };
    memory->device->instance.api.vkGetPhysicalDeviceMemoryProperties2(memory->device->physical,
                                                                      &properties);
    return subtract(budget.heapBudget[heap], budget.heapUsage[heap]);
}

static uint64_t limit_room(const engine_memory *memory) {
    return memory->limit ? subtract(memory->limit, memory->allocated) : UINT64_MAX;
}

static uint64_t minimum(uint64_t first, uint64_t second) {
    return first < second ? first : second;
}

static uint64_t maximum(uint64_t first, uint64_t second) {
    return first > second ? first : second;
}

/// Where errors are logged; NULL: nowhere.
static const lobe_host *log_of(const engine_memory *memory, const engine_memory_request *request) {
    return request->name ? &memory->device->host : NULL;
}

static lobe_result fail_without_room(const engine_memory *memory,
                                     const engine_memory_request *request, uint64_t room) {
    return lobe_host_fail(log_of(memory, request), LOBE_ERROR_OUT_OF_DEVICE_MEMORY,
                          "'%s' needs %llu bytes of device memory, only %llu are available%s",
                          request->name, (unsigned long long)request->requirements.size,
                          (unsigned long long)room, memory->limit ? " (limited)" : "");
}

/// Blocks for host access are mapped as a whole, so the two uses of one type are kept apart.
static bool block_serves(const engine_memory_block *block, uint32_t type, bool linear,
                         engine_memory_place place) {
    return block->type == type && block->linear == linear &&
           (block->mapped != NULL) == (place != ENGINE_MEMORY_DEVICE);
}

static VkDeviceSize usual_block_size(const engine_memory *memory, uint32_t type, bool linear,
                                     engine_memory_place place) {
    VkDeviceSize sum = 0;
    for (const engine_memory_block *block = memory->blocks; block; block = block->next)
        if (block_serves(block, type, linear, place))
            sum += block->size;
    return minimum(maximum(sum, SMALLEST_BLOCK), LARGEST_BLOCK);
}

/// Chooses the usual size, or that of a larger request. When the heap is nearly full it takes only
/// an eighth of the rest, because other memory types need blocks too.
static lobe_result choose_block_size(const engine_memory *memory,
                                     const engine_memory_request *request, uint32_t type,
                                     bool linear, VkDeviceSize *size) {
    const uint32_t heap = memory->properties.memoryTypes[type].heapIndex;
    const uint64_t room =
        minimum(minimum(heap_room(memory, heap), limit_room(memory)), memory->maximum_allocation);
    if (request->requirements.size > room)
        return fail_without_room(memory, request, room);
    const VkDeviceSize usual = usual_block_size(memory, type, linear, request->place);
    *size = maximum(request->requirements.size, minimum(usual, room / 8));
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Blocks

static lobe_result take_from_vulkan(engine_memory *memory, const engine_memory_request *request,
                                    engine_memory_block *block) {
    const VkMemoryAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = block->size,
        .memoryTypeIndex = block->type,
    };
    const lobe_device *device = memory->device;
    const lobe_host *log = log_of(memory, request);
    lobe_result result = VULKAN_CHECK(
        log,
        device->api.vkAllocateMemory(device->vulkan, &allocate, device->callbacks, &block->memory),
        "'%s' (%llu bytes)", request->name, (unsigned long long)request->requirements.size);
    if (result == LOBE_OK && request->place != ENGINE_MEMORY_DEVICE)
        result = VULKAN_CHECK(log,
                              device->api.vkMapMemory(device->vulkan, block->memory, 0,
                                                      VK_WHOLE_SIZE, 0, &block->mapped),
                              "'%s'", request->name);
    return result;
}

static lobe_result fail_host_memory(const engine_memory *memory,
                                    const engine_memory_request *request) {
    return lobe_host_fail(log_of(memory, request), LOBE_ERROR_OUT_OF_MEMORY,
                          "'%s': out of memory managing device memory", request->name);
}

static lobe_result add_block(engine_memory *memory, const engine_memory_request *request,
                             uint32_t type, bool linear, engine_memory_block **added) {
    VkDeviceSize size = 0;
    lobe_result result = choose_block_size(memory, request, type, linear, &size);
    if (result != LOBE_OK)
        return result;
    const lobe_allocator *allocator = memory->device->host.allocator;
    engine_memory_block *block = lobe_allocate(allocator, 1, sizeof *block);
    if (!block || !engine_range_allocator_create(allocator, size, &block->ranges)) {
        lobe_release(block);
        return fail_host_memory(memory, request);
    }
    block->size = size;
    block->type = type;
    block->linear = linear;
    memory->allocated += size;
    memory->allocated_of_heap[memory->properties.memoryTypes[type].heapIndex] += size;
    result = take_from_vulkan(memory, request, block);
    if (result != LOBE_OK) {
        release_block(memory, block);
        return result;
    }
    block->next = memory->blocks;
    memory->blocks = block;
    *added = block;
    return LOBE_OK;
}

static bool take_from_block(engine_memory *memory, engine_memory_block *block,
                            const VkMemoryRequirements *requirements,
                            engine_allocation *allocation) {
    uint64_t offset;
    if (!engine_range_allocate(&block->ranges, requirements->size, requirements->alignment,
                               &offset))
        return false;
    *allocation = (engine_allocation){
        .memory = block->memory,
        .offset = offset,
        .size = requirements->size,
        .mapped = block->mapped ? (char *)block->mapped + offset : NULL,
        .block = block,
    };
    memory->used += requirements->size;
    memory->peak = maximum(memory->peak, memory->used);
    return true;
}

static lobe_result allocate(engine_memory *memory, const engine_memory_request *request,
                            engine_allocation *allocation) {
    const uint32_t type = find_type(memory, request);
    if (type == UINT32_MAX)
        return lobe_host_fail(log_of(memory, request), LOBE_ERROR_OUT_OF_DEVICE_MEMORY,
                              "'%s': the device has no suitable memory type", request->name);
    // With a granularity of 1, tiled images and buffers may share blocks.
    const bool linear = request->linear && memory->granularity > 1;
    for (engine_memory_block *block = memory->blocks; block; block = block->next) {
        if (!block_serves(block, type, linear, request->place))
            continue;
        if (!engine_range_reserve(&block->ranges))
            return fail_host_memory(memory, request);
        if (take_from_block(memory, block, &request->requirements, allocation))
            return LOBE_OK;
    }
    engine_memory_block *block = NULL;
    const lobe_result result = add_block(memory, request, type, linear, &block);
    if (result != LOBE_OK)
        return result;
    if (take_from_block(memory, block, &request->requirements, allocation))
        return LOBE_OK;
    return fail_host_memory(memory, request);
}

lobe_result engine_memory_allocate(engine_memory *memory, const engine_memory_request *request,
                                   engine_allocation *allocation) {
    *allocation = (engine_allocation){0};
    pthread_mutex_lock(&memory->mutex);
    const lobe_result result = allocate(memory, request, allocation);
    pthread_mutex_unlock(&memory->mutex);
    return result;
}

static void give_back(engine_memory *memory, engine_allocation *allocation) {
    engine_memory_block *block = allocation->block;
    engine_range_free(&block->ranges, allocation->offset, allocation->size);
    memory->used -= allocation->size;
    *allocation = (engine_allocation){0};
    if (block->ranges.taken_count)
        return;
    engine_memory_block **link = &memory->blocks;
    while (*link != block)
        link = &(*link)->next;
    *link = block->next;
    release_block(memory, block);
}

void engine_memory_free(engine_memory *memory, engine_allocation *allocation) {
    if (!allocation->block)
        return;
    pthread_mutex_lock(&memory->mutex);
    give_back(memory, allocation);
    pthread_mutex_unlock(&memory->mutex);
}

// ---------------------------------------------------------------------------------------------
// Facts

static uint64_t device_heap_room(const engine_memory *memory) {
    uint64_t room = 0;
    for (uint32_t heap = 0; heap < memory->properties.memoryHeapCount; heap++)
        if (memory->properties.memoryHeaps[heap].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            room = maximum(room, heap_room(memory, heap));
    return room;
}

void engine_memory_query(engine_memory *memory, lobe_device_memory *information) {
    pthread_mutex_lock(&memory->mutex);
    *information = (lobe_device_memory){
        .allocated_bytes = memory->allocated,
        .used_bytes = memory->used,
        .peak_used_bytes = memory->peak,
        .budget_bytes = memory->allocated + minimum(device_heap_room(memory), limit_room(memory)),
    };
    pthread_mutex_unlock(&memory->mutex);
}

void engine_memory_reset_peak(engine_memory *memory) {
    pthread_mutex_lock(&memory->mutex);
    memory->peak = memory->used;
    pthread_mutex_unlock(&memory->mutex);
}
