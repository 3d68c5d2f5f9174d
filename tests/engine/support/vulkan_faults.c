#include "tests/engine/support/vulkan_faults.h"

#include <stddef.h>
#include <string.h>

#include "tests/engine/support/host_device.h"

vulkan_faults faults;

// ---------------------------------------------------------------------------------------------
// Stand-ins for the loader's functions

typedef struct stand_in {
    const char *vulkan_name;
    PFN_vkVoidFunction function;
    bool fallible;
    bool failed; ///< at least once
    _Atomic int calls;
    struct stand_in *next;
} stand_in;

static stand_in *all_stand_ins;

static bool fails(stand_in *function) {
    function->calls++;
    if (faults.paused || ++faults.calls != faults.failing)
        return false;
    faults.failed = function->vulkan_name;
    function->failed = true;
    return true;
}

int vulkan_calls(const char *name) {
    const stand_in *function = all_stand_ins;
    while (strcmp(function->vulkan_name, name) != 0)
        function = function->next;
    return function->calls;
}

const char *vulkan_fault_left_out(void) {
    for (const stand_in *function = all_stand_ins; function; function = function->next)
        if (function->fallible && !function->failed)
            return function->vulkan_name;
    return NULL;
}

/// Lists a function fault_NAME before the program starts. vulkan_calls.py looks for these names.
#define STAND_IN(name, can_fail)                                                                   \
    static stand_in stand_in_##name = {                                                            \
        .vulkan_name = #name, .function = (PFN_vkVoidFunction)fault_##name, .fallible = can_fail}; \
    __attribute__((constructor)) static void list_##name(void) {                                   \
        stand_in_##name.next = all_stand_ins;                                                      \
        all_stand_ins = &stand_in_##name;                                                          \
    }

/// Begins the definition of a stand-in.
#define FUNCTION(type, name, parameters, can_fail)                                                 \
    static VKAPI_ATTR type VKAPI_CALL fault_##name parameters;                                     \
    STAND_IN(name, can_fail)                                                                       \
    static VKAPI_ATTR type VKAPI_CALL fault_##name parameters

#define FALLIBLE(name, parameters, arguments)                                                      \
    FUNCTION(VkResult, name, parameters, true) {                                                   \
        return fails(&stand_in_##name) ? faults.fault : name arguments;                            \
    }

#define MAKES(name, parameters, arguments)                                                         \
    FUNCTION(VkResult, name, parameters, true) {                                                   \
        if (fails(&stand_in_##name))                                                               \
            return faults.fault;                                                                   \
        VkResult result = name arguments;                                                          \
        faults.alive += result == VK_SUCCESS;                                                      \
        faults.made += result == VK_SUCCESS;                                                       \
        return result;                                                                             \
    }

/// Objects allocated from a pool are destroyed with it.
#define TAKES(name, parameters, arguments)                                                         \
    FUNCTION(VkResult, name, parameters, true) {                                                   \
        if (fails(&stand_in_##name))                                                               \
            return faults.fault;                                                                   \
        VkResult result = name arguments;                                                          \
        faults.made += result == VK_SUCCESS;                                                       \
        return result;                                                                             \
    }

#define DESTROYS(name, handle)                                                                     \
    FUNCTION(void, name, (VkDevice device, handle gone, const VkAllocationCallbacks *callbacks),   \
             false) {                                                                              \
        faults.alive -= gone != VK_NULL_HANDLE;                                                    \
        name(device, gone, callbacks);                                                             \
    }

/// Objects that a device creates from a description.
#define OBJECT(name)                                                                               \
    MAKES(vkCreate##name,                                                                          \
          (VkDevice device, const Vk##name##CreateInfo *create,                                    \
           const VkAllocationCallbacks *callbacks, Vk##name *made),                                \
          (device, create, callbacks, made))                                                       \
    DESTROYS(vkDestroy##name, Vk##name)

OBJECT(Buffer)
OBJECT(CommandPool)
OBJECT(DescriptorPool)
OBJECT(DescriptorSetLayout)
OBJECT(Image)
OBJECT(ImageView)
OBJECT(PipelineCache)
OBJECT(PipelineLayout)
OBJECT(QueryPool)
OBJECT(Sampler)
OBJECT(Semaphore)
OBJECT(ShaderModule)

#define PIPELINES(kind)                                                                            \
    FUNCTION(VkResult, vkCreate##kind##Pipelines,                                                  \
             (VkDevice device, VkPipelineCache cache, uint32_t count,                              \
              const Vk##kind##PipelineCreateInfo *create, const VkAllocationCallbacks *callbacks,  \
              VkPipeline *made),                                                                   \
             true) {                                                                               \
        const VkResult refusal = faults.making ? faults.making() : VK_SUCCESS;                     \
        if (refusal != VK_SUCCESS)                                                                 \
            return refusal;                                                                        \
        if (fails(&stand_in_vkCreate##kind##Pipelines))                                            \
            return faults.fault;                                                                   \
        VkResult result =                                                                          \
            vkCreate##kind##Pipelines(device, cache, count, create, callbacks, made);              \
        if (result == VK_SUCCESS) {                                                                \
            faults.alive++;                                                                        \
            faults.made++;                                                                         \
            faults.pipelines++;                                                                    \
            faults.pipelines_alive++;                                                              \
        }                                                                                          \
        return result;                                                                             \
    }

PIPELINES(Compute)
PIPELINES(Graphics)
FUNCTION(void, vkDestroyPipeline,
         (VkDevice device, VkPipeline gone, const VkAllocationCallbacks *callbacks), false) {
    faults.alive -= gone != VK_NULL_HANDLE;
    faults.pipelines_alive -= gone != VK_NULL_HANDLE;
    vkDestroyPipeline(device, gone, callbacks);
}
MAKES(vkAllocateMemory,
      (VkDevice device, const VkMemoryAllocateInfo *allocate,
       const VkAllocationCallbacks *callbacks, VkDeviceMemory *made),
      (device, allocate, callbacks, made))
DESTROYS(vkFreeMemory, VkDeviceMemory)

MAKES(vkCreateInstance,
      (const VkInstanceCreateInfo *create, const VkAllocationCallbacks *callbacks,
       VkInstance *made),
      (create, callbacks, made))
MAKES(vkCreateDevice,
      (VkPhysicalDevice physical, const VkDeviceCreateInfo *create,
       const VkAllocationCallbacks *callbacks, VkDevice *made),
      (physical, create, callbacks, made))

FUNCTION(void, vkDestroyInstance, (VkInstance gone, const VkAllocationCallbacks *callbacks),
         false) {
    faults.alive -= gone != VK_NULL_HANDLE;
    vkDestroyInstance(gone, callbacks);
}

FUNCTION(void, vkDestroyDevice, (VkDevice gone, const VkAllocationCallbacks *callbacks), false) {
    faults.alive -= gone != VK_NULL_HANDLE;
    vkDestroyDevice(gone, callbacks);
}

TAKES(vkAllocateCommandBuffers,
      (VkDevice device, const VkCommandBufferAllocateInfo *allocate, VkCommandBuffer *made),
      (device, allocate, made))
TAKES(vkAllocateDescriptorSets,
      (VkDevice device, const VkDescriptorSetAllocateInfo *allocate, VkDescriptorSet *made),
      (device, allocate, made))
FALLIBLE(vkBeginCommandBuffer, (VkCommandBuffer commands, const VkCommandBufferBeginInfo *begin),
         (commands, begin))
FALLIBLE(vkEndCommandBuffer, (VkCommandBuffer commands), (commands))
FALLIBLE(vkBindBufferMemory,
         (VkDevice device, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset),
         (device, buffer, memory, offset))
FALLIBLE(vkBindImageMemory,
         (VkDevice device, VkImage image, VkDeviceMemory memory, VkDeviceSize offset),
         (device, image, memory, offset))
FALLIBLE(vkEnumeratePhysicalDevices,
         (VkInstance instance, uint32_t *count, VkPhysicalDevice *devices),
         (instance, count, devices))
FALLIBLE(vkMapMemory,
         (VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
          VkMemoryMapFlags flags, void **mapped),
         (device, memory, offset, size, flags, mapped))
FALLIBLE(vkGetPhysicalDeviceImageFormatProperties2,
         (VkPhysicalDevice physical, const VkPhysicalDeviceImageFormatInfo2 *query,
          VkImageFormatProperties2 *properties),
         (physical, query, properties))
FALLIBLE(vkGetQueryPoolResults,
         (VkDevice device, VkQueryPool pool, uint32_t first, uint32_t count, size_t size,
          void *data, VkDeviceSize stride, VkQueryResultFlags flags),
         (device, pool, first, count, size, data, stride, flags))
FALLIBLE(vkQueueSubmit2,
         (VkQueue queue, uint32_t count, const VkSubmitInfo2 *submits, VkFence fence),
         (queue, count, submits, fence))
FALLIBLE(vkResetCommandPool, (VkDevice device, VkCommandPool pool, VkCommandPoolResetFlags flags),
         (device, pool, flags))
FALLIBLE(vkResetDescriptorPool,
         (VkDevice device, VkDescriptorPool pool, VkDescriptorPoolResetFlags flags),
         (device, pool, flags))

FALLIBLE(vkEnumerateDeviceExtensionProperties,
         (VkPhysicalDevice physical, const char *layer, uint32_t *count,
          VkExtensionProperties *properties),
         (physical, layer, count, properties))
FALLIBLE(vkEnumerateInstanceExtensionProperties,
         (const char *layer, uint32_t *count, VkExtensionProperties *properties),
         (layer, count, properties))
FALLIBLE(vkEnumerateInstanceLayerProperties, (uint32_t * count, VkLayerProperties *properties),
         (count, properties))
FALLIBLE(vkGetPipelineCacheData, (VkDevice device, VkPipelineCache cache, size_t *size, void *data),
         (device, cache, size, data))

/// The wait succeeds all the same: a lost device no longer runs anything.
#define WAITS(name, parameters, arguments)                                                         \
    FUNCTION(VkResult, name, parameters, true) {                                                   \
        VkResult result = name arguments;                                                          \
        return fails(&stand_in_##name) ? faults.fault : result;                                    \
    }

WAITS(vkWaitSemaphores, (VkDevice device, const VkSemaphoreWaitInfo *wait, uint64_t timeout),
      (device, wait, timeout))
WAITS(vkDeviceWaitIdle, (VkDevice device), (device))

/// Called only where a submission has failed already.
FUNCTION(VkResult, vkQueueWaitIdle, (VkQueue queue), false) {
    ++stand_in_vkQueueWaitIdle.calls;
    return vkQueueWaitIdle(queue);
}

/// Its failure is no failure of lobe's: pipelines are kept for longer.
FUNCTION(VkResult, vkGetSemaphoreCounterValue,
         (VkDevice device, VkSemaphore semaphore, uint64_t *value), false) {
    return faults.timeline_unknown ? faults.fault
                                   : vkGetSemaphoreCounterValue(device, semaphore, value);
}

// ---------------------------------------------------------------------------------------------
// Functions of extensions, which libvulkan does not export

static PFN_vkCreateDebugUtilsMessengerEXT real_create_messenger;
static PFN_vkSetDebugUtilsObjectNameEXT real_set_name;

FUNCTION(VkResult, vkCreateDebugUtilsMessengerEXT,
         (VkInstance instance, const VkDebugUtilsMessengerCreateInfoEXT *create,
          const VkAllocationCallbacks *callbacks, VkDebugUtilsMessengerEXT *made),
         true) {
    return fails(&stand_in_vkCreateDebugUtilsMessengerEXT)
               ? faults.fault
               : real_create_messenger(instance, create, callbacks, made);
}

FUNCTION(VkResult, vkSetDebugUtilsObjectNameEXT,
         (VkDevice device, const VkDebugUtilsObjectNameInfoEXT *name), true) {
    return faults.names && fails(&stand_in_vkSetDebugUtilsObjectNameEXT)
               ? faults.fault
               : real_set_name(device, name);
}

// ---------------------------------------------------------------------------------------------
// The loader

/// The stand-in for a function that the loader has, or that function.
static PFN_vkVoidFunction replace(PFN_vkVoidFunction real, const char *name) {
    if (faults.absent && strcmp(name, faults.absent) == 0)
        return NULL;
    for (const stand_in *function = all_stand_ins; real && function; function = function->next)
        if (strcmp(name, function->vulkan_name) == 0)
            return function->function;
    return real;
}

FUNCTION(PFN_vkVoidFunction, vkGetDeviceProcAddr, (VkDevice device, const char *name), false) {
    return replace(vkGetDeviceProcAddr(device, name), name);
}

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                       const char *name) {
    const PFN_vkVoidFunction real = vkGetInstanceProcAddr(instance, name);
    if (real && strcmp(name, "vkCreateDebugUtilsMessengerEXT") == 0)
        real_create_messenger = (PFN_vkCreateDebugUtilsMessengerEXT)real;
    if (real && strcmp(name, "vkSetDebugUtilsObjectNameEXT") == 0)
        real_set_name = (PFN_vkSetDebugUtilsObjectNameEXT)real;
    return replace(real, name);
}

__attribute__((constructor)) static void stand_in_for_the_loader(void) {
    test_vulkan_loader = get_instance_proc_addr;
}
