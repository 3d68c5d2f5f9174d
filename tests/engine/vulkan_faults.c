#include "tests/engine/vulkan_faults.h"

#include <dlfcn.h>
#include <stdbool.h>

vulkan_faults faults;

static bool fails(const char *name) {
    if (++faults.calls != faults.failing)
        return false;
    faults.failed = name;
    return true;
}

#define REAL(name) ((PFN_##name)dlsym(RTLD_NEXT, #name))

#define FALLIBLE(name, parameters, arguments)                                                      \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                               \
        return fails(#name) ? faults.fault : REAL(name) arguments;                                 \
    }

#define MAKES(name, parameters, arguments)                                                         \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                               \
        if (fails(#name))                                                                          \
            return faults.fault;                                                                   \
        VkResult result = REAL(name) arguments;                                                    \
        faults.alive += result == VK_SUCCESS;                                                      \
        faults.made += result == VK_SUCCESS;                                                       \
        return result;                                                                             \
    }

/// What is taken from a pool goes with it.
#define TAKES(name, parameters, arguments)                                                         \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                               \
        if (fails(#name))                                                                          \
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
    VKAPI_ATTR VkResult VKAPI_CALL vkCreate##kind##Pipelines(                                      \
        VkDevice device, VkPipelineCache cache, uint32_t count,                                    \
        const Vk##kind##PipelineCreateInfo *create, const VkAllocationCallbacks *callbacks,        \
        VkPipeline *made) {                                                                        \
        if (fails("vkCreate" #kind "Pipelines"))                                                   \
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

/// What is waited for is done all the same: a device that is lost runs nothing any more.
VKAPI_ATTR VkResult VKAPI_CALL vkWaitSemaphores(VkDevice device, const VkSemaphoreWaitInfo *wait,
                                                uint64_t timeout) {
    VkResult result = REAL(vkWaitSemaphores)(device, wait, timeout);
    return fails("vkWaitSemaphores") ? faults.fault : result;
}
