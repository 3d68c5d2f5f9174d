#ifndef ENGINE_DEVICE_VULKAN_FUNCTIONS_H
#define ENGINE_DEVICE_VULKAN_FUNCTIONS_H

#include <stdbool.h>

#include <vulkan/vulkan.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// The Vulkan functions that lobe calls, in tables of each instance and device. Nothing refers to a
/// `vk*` symbol, so lobe links beside libvulkan, a statically linked loader, or a host's volk, and
/// devices of different loaders can be open at once. (volk itself keeps its functions in global
/// variables named like libvulkan's functions, which rules it out in a library.)

#define ENGINE_LOADER_FUNCTIONS(X)                                                                 \
    X(vkCreateInstance)                                                                            \
    X(vkEnumerateInstanceExtensionProperties)                                                      \
    X(vkEnumerateInstanceLayerProperties)

#define ENGINE_INSTANCE_FUNCTIONS(X)                                                               \
    X(vkCreateDevice)                                                                              \
    X(vkDestroyInstance)                                                                           \
    X(vkEnumerateDeviceExtensionProperties)                                                        \
    X(vkEnumeratePhysicalDevices)                                                                  \
    X(vkGetDeviceProcAddr)                                                                         \
    X(vkGetPhysicalDeviceFeatures2)                                                                \
    X(vkGetPhysicalDeviceFormatProperties)                                                         \
    X(vkGetPhysicalDeviceImageFormatProperties2)                                                   \
    X(vkGetPhysicalDeviceMemoryProperties)                                                         \
    X(vkGetPhysicalDeviceMemoryProperties2)                                                        \
    X(vkGetPhysicalDeviceProperties)                                                               \
    X(vkGetPhysicalDeviceProperties2)                                                              \
    X(vkGetPhysicalDeviceQueueFamilyProperties)

/// VK_EXT_debug_utils.
#define ENGINE_DEBUG_FUNCTIONS(X)                                                                  \
    X(vkCmdBeginDebugUtilsLabelEXT)                                                                \
    X(vkCmdEndDebugUtilsLabelEXT)                                                                  \
    X(vkCreateDebugUtilsMessengerEXT)                                                              \
    X(vkDestroyDebugUtilsMessengerEXT)                                                             \
    X(vkSetDebugUtilsObjectNameEXT)

#define ENGINE_DEVICE_FUNCTIONS(X)                                                                 \
    X(vkAllocateCommandBuffers)                                                                    \
    X(vkAllocateDescriptorSets)                                                                    \
    X(vkAllocateMemory)                                                                            \
    X(vkBeginCommandBuffer)                                                                        \
    X(vkBindBufferMemory)                                                                          \
    X(vkBindImageMemory)                                                                           \
    X(vkCmdBeginRendering)                                                                         \
    X(vkCmdBindDescriptorSets)                                                                     \
    X(vkCmdBindIndexBuffer)                                                                        \
    X(vkCmdBindPipeline)                                                                           \
    X(vkCmdClearColorImage)                                                                        \
    X(vkCmdClearDepthStencilImage)                                                                 \
    X(vkCmdCopyBuffer)                                                                             \
    X(vkCmdCopyBufferToImage)                                                                      \
    X(vkCmdCopyImage)                                                                              \
    X(vkCmdCopyImageToBuffer)                                                                      \
    X(vkCmdDispatch)                                                                               \
    X(vkCmdDispatchIndirect)                                                                       \
    X(vkCmdDraw)                                                                                   \
    X(vkCmdDrawIndexed)                                                                            \
    X(vkCmdDrawIndexedIndirect)                                                                    \
    X(vkCmdDrawIndirect)                                                                           \
    X(vkCmdEndRendering)                                                                           \
    X(vkCmdFillBuffer)                                                                             \
    X(vkCmdPipelineBarrier2)                                                                       \
    X(vkCmdPushConstants)                                                                          \
    X(vkCmdResetQueryPool)                                                                         \
    X(vkCmdSetScissor)                                                                             \
    X(vkCmdSetViewport)                                                                            \
    X(vkCmdWriteTimestamp2)                                                                        \
    X(vkCreateBuffer)                                                                              \
    X(vkCreateCommandPool)                                                                         \
    X(vkCreateComputePipelines)                                                                    \
    X(vkCreateDescriptorPool)                                                                      \
    X(vkCreateDescriptorSetLayout)                                                                 \
    X(vkCreateGraphicsPipelines)                                                                   \
    X(vkCreateImage)                                                                               \
    X(vkCreateImageView)                                                                           \
    X(vkCreatePipelineCache)                                                                       \
    X(vkCreatePipelineLayout)                                                                      \
    X(vkCreateQueryPool)                                                                           \
    X(vkCreateSampler)                                                                             \
    X(vkCreateSemaphore)                                                                           \
    X(vkCreateShaderModule)                                                                        \
    X(vkDestroyBuffer)                                                                             \
    X(vkDestroyCommandPool)                                                                        \
    X(vkDestroyDescriptorPool)                                                                     \
    X(vkDestroyDescriptorSetLayout)                                                                \
    X(vkDestroyDevice)                                                                             \
    X(vkDestroyImage)                                                                              \
    X(vkDestroyImageView)                                                                          \
    X(vkDestroyPipeline)                                                                           \
    X(vkDestroyPipelineCache)                                                                      \
    X(vkDestroyPipelineLayout)                                                                     \
    X(vkDestroyQueryPool)                                                                          \
    X(vkDestroySampler)                                                                            \
    X(vkDestroySemaphore)                                                                          \
    X(vkDestroyShaderModule)                                                                       \
    X(vkDeviceWaitIdle)                                                                            \
    X(vkEndCommandBuffer)                                                                          \
    X(vkFreeCommandBuffers)                                                                        \
    X(vkFreeMemory)                                                                                \
    X(vkGetBufferMemoryRequirements)                                                               \
    X(vkGetDeviceQueue)                                                                            \
    X(vkGetImageMemoryRequirements)                                                                \
    X(vkGetPipelineCacheData)                                                                      \
    X(vkGetQueryPoolResults)                                                                       \
    X(vkGetSemaphoreCounterValue)                                                                  \
    X(vkMapMemory)                                                                                 \
    X(vkQueueSubmit2)                                                                              \
    X(vkQueueWaitIdle)                                                                             \
    X(vkResetCommandPool)                                                                          \
    X(vkResetDescriptorPool)                                                                       \
    X(vkUpdateDescriptorSets)                                                                      \
    X(vkWaitSemaphores)

#define ENGINE_FUNCTION_MEMBER(function) PFN_##function function;

typedef struct engine_instance_api {
    PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr;
    ENGINE_LOADER_FUNCTIONS(ENGINE_FUNCTION_MEMBER)
    ENGINE_INSTANCE_FUNCTIONS(ENGINE_FUNCTION_MEMBER)
    ENGINE_DEBUG_FUNCTIONS(ENGINE_FUNCTION_MEMBER) ///< NULL without VK_EXT_debug_utils
} engine_instance_api;

typedef struct engine_device_api {
    ENGINE_DEVICE_FUNCTIONS(ENGINE_FUNCTION_MEMBER)
} engine_device_api;

/// Fills the part of the table that needs no instance. `get_instance_proc_addr`: the host's; NULL:
/// that of libvulkan.so.1, which is loaded and stays loaded until the process ends.
/// LOBE_ERROR_NO_DEVICE: there is no libvulkan.so.1.
lobe_result engine_loader_open(const lobe_host *host,
                               PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                               engine_instance_api *api);
/// Fills the rest. `debug_utils`: the instance has VK_EXT_debug_utils.
/// LOBE_ERROR_NO_DEVICE: a function is missing (the line names it); all others are filled in.
lobe_result engine_instance_api_load(const lobe_host *host, VkInstance instance, bool debug_utils,
                                     engine_instance_api *api);
/// As engine_instance_api_load.
lobe_result engine_device_api_load(const lobe_host *host, const engine_instance_api *instance,
                                   VkDevice device, engine_device_api *api);

#endif
