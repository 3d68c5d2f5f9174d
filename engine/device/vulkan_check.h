#ifndef ENGINE_DEVICE_VULKAN_CHECK_H
#define ENGINE_DEVICE_VULKAN_CHECK_H

#include <vulkan/vulkan.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// Translates a VkResult for lobe's callers. All success codes give LOBE_OK.
lobe_result engine_vulkan_result(VkResult result);

/// Calls Vulkan and returns a lobe_result. An error is logged as one line with the function and
/// what it was called for, unless `log` is NULL: `result = VULKAN_CHECK(&device->host,
/// device->api.vkCreateImage(...), "image '%s'", name);`
#define VULKAN_CHECK(log, call, ...) engine_vulkan_check((log), (call), #call, __VA_ARGS__)

lobe_result engine_vulkan_check(const lobe_host *host, VkResult result, const char *expression,
                                const char *format, ...) __attribute__((format(printf, 4, 5)));

#endif
