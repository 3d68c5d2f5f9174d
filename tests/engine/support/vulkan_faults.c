#include "tests/engine/support/vulkan_faults.h"

#include <dlfcn.h>
#include <stddef.h>
#include <string.h>

vulkan_faults faults;

// ---------------------------------------------------------------------------------------------
// What can fail

typedef struct fallible {
    const char *name;
    bool failed; ///< once at least
    struct fallible *next;
} fallible;

static fallible *all_fallible;

static bool fails(fallible *function) {
    if (faults.paused || ++faults.calls != faults.failing)
        return false;
    faults.failed = function->name;
    function->failed = true;
    return true;
}

const char *vulkan_fault_left_out(void) {
    for (const fallible *function = all_fallible; function; function = function->next)
        if (!function->failed)
            return function->name;
    return NULL;
}

/// Each is listed before the program starts.
#define LISTED(function)                                                                           \
    static fallible fallible_##function = {.name = #function};                                     \
    __attribute__((constructor)) static void list_##function(void) {                               \
        fallible_##function.next = all_fallible;                                                   \
        all_fallible = &fallible_##function;                                                       \
    }

// ---------------------------------------------------------------------------------------------
// Functions of Vulkan

#define REAL(name) ((PFN_##name)dlsym(RTLD_NEXT, #name))

#define FALLIBLE(name, parameters, arguments)                                                      \
    LISTED(name)                                                                                   \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                               \
        return fails(&fallible_##name) ? faults.fault : REAL(name) arguments;                      \
    }

#define MAKES(name, parameters, arguments)                                                         \
    LISTED(name)                                                                                   \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                               \
        if (fails(&fallible_##name))                                                               \
            return faults.fault;                                                                   \
        VkResult result = REAL(name) arguments;                                                    \
        faults.alive += result == VK_SUCCESS;                                                      \
        faults.made += result == VK_SUCCESS;                                                       \
        return result;                                                                             \
    }

/// What is taken from a pool goes with it.
#define TAKES(name, parameters, arguments)                                                         \
    LISTED(name)                                                                                   \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                               \
        if (fails(&fallible_##name))                                                               \
            return faults.fault;                                                                   \
        VkResult result = REAL(name) arguments;                                                    \
        faults.made += result == VK_SUCCESS;                                                       \
        return result;                                                                             \
    }

#define DESTROYS(name, handle)                                                                     \
    VKAPI_ATTR void VKAPI_CALL name(VkDevice device, handle gone,                                  \
                                    const VkAllocationCallbacks *callbacks) {                      \
        faults.alive -= gone != VK_NULL_HANDLE;                                                    \
        REAL(name)(device, gone, callbacks);                                                       \
    }

/// What a device makes by a structure that describes it.
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
    LISTED(vkCreate##kind##Pipelines)                                                              \
    VKAPI_ATTR VkResult VKAPI_CALL vkCreate##kind##Pipelines(                                      \
        VkDevice device, VkPipelineCache cache, uint32_t count,                                    \
        const Vk##kind##PipelineCreateInfo *create, const VkAllocationCallbacks *callbacks,        \
        VkPipeline *made) {                                                                        \
        if (fails(&fallible_vkCreate##kind##Pipelines))                                            \
            return faults.fault;                                                                   \
        VkResult result =                                                                          \
            REAL(vkCreate##kind##Pipelines)(device, cache, count, create, callbacks, made);        \
        if (result == VK_SUCCESS) {                                                                \
            faults.alive++;                                                                        \
            faults.made++;                                                                         \
            faults.pipelines++;                                                                    \
        }                                                                                          \
        return result;                                                                             \
    }

PIPELINES(Compute)
PIPELINES(Graphics)
DESTROYS(vkDestroyPipeline, VkPipeline)
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

VKAPI_ATTR void VKAPI_CALL vkDestroyInstance(VkInstance gone,
                                             const VkAllocationCallbacks *callbacks) {
    faults.alive -= gone != VK_NULL_HANDLE;
    REAL(vkDestroyInstance)(gone, callbacks);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyDevice(VkDevice gone, const VkAllocationCallbacks *callbacks) {
    faults.alive -= gone != VK_NULL_HANDLE;
    REAL(vkDestroyDevice)(gone, callbacks);
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

/// What is waited for is done all the same: a device that is lost runs nothing any more.
#define WAITS(name, parameters, arguments)                                                         \
    LISTED(name)                                                                                   \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                               \
        VkResult result = REAL(name) arguments;                                                    \
        return fails(&fallible_##name) ? faults.fault : result;                                    \
    }

WAITS(vkWaitSemaphores, (VkDevice device, const VkSemaphoreWaitInfo *wait, uint64_t timeout),
      (device, wait, timeout))
WAITS(vkDeviceWaitIdle, (VkDevice device), (device))
WAITS(vkQueueWaitIdle, (VkQueue queue), (queue))

// ---------------------------------------------------------------------------------------------
// Functions of extensions, which are asked for by name

static PFN_vkCreateDebugUtilsMessengerEXT real_create_messenger;
static PFN_vkSetDebugUtilsObjectNameEXT real_set_name;

LISTED(vkCreateDebugUtilsMessengerEXT)
VKAPI_ATTR VkResult VKAPI_CALL vkCreateDebugUtilsMessengerEXT(
    VkInstance instance, const VkDebugUtilsMessengerCreateInfoEXT *create,
    const VkAllocationCallbacks *callbacks, VkDebugUtilsMessengerEXT *made) {
    return fails(&fallible_vkCreateDebugUtilsMessengerEXT)
               ? faults.fault
               : real_create_messenger(instance, create, callbacks, made);
}

LISTED(vkSetDebugUtilsObjectNameEXT)
VKAPI_ATTR VkResult VKAPI_CALL
vkSetDebugUtilsObjectNameEXT(VkDevice device, const VkDebugUtilsObjectNameInfoEXT *name) {
    return faults.names && fails(&fallible_vkSetDebugUtilsObjectNameEXT)
               ? faults.fault
               : real_set_name(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance,
                                                               const char *name) {
    const PFN_vkVoidFunction real = REAL(vkGetInstanceProcAddr)(instance, name);
    if (real && strcmp(name, "vkCreateDebugUtilsMessengerEXT") == 0) {
        real_create_messenger = (PFN_vkCreateDebugUtilsMessengerEXT)real;
        return (PFN_vkVoidFunction)vkCreateDebugUtilsMessengerEXT;
    }
    if (real && strcmp(name, "vkSetDebugUtilsObjectNameEXT") == 0) {
        real_set_name = (PFN_vkSetDebugUtilsObjectNameEXT)real;
        return (PFN_vkVoidFunction)vkSetDebugUtilsObjectNameEXT;
    }
    return real;
}
