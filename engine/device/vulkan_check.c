#include "engine/device/vulkan_check.h"

#include <stdarg.h>
#include <stdio.h>

typedef struct vulkan_result_meaning {
    VkResult vulkan;
    const char *name;
    lobe_result meaning;
} vulkan_result_meaning;

#define MEANING(code, result)                                                                      \
    { code, #code, result }

static const vulkan_result_meaning meanings[] = {
    MEANING(VK_SUCCESS, LOBE_OK),
    MEANING(VK_NOT_READY, LOBE_OK),
    MEANING(VK_TIMEOUT, LOBE_OK),
    MEANING(VK_INCOMPLETE, LOBE_OK),
    MEANING(VK_PIPELINE_COMPILE_REQUIRED, LOBE_OK),
    MEANING(VK_ERROR_OUT_OF_HOST_MEMORY, LOBE_ERROR_OUT_OF_MEMORY),
    MEANING(VK_ERROR_OUT_OF_DEVICE_MEMORY, LOBE_ERROR_OUT_OF_DEVICE_MEMORY),
    MEANING(VK_ERROR_MEMORY_MAP_FAILED, LOBE_ERROR_OUT_OF_MEMORY),
    MEANING(VK_ERROR_OUT_OF_POOL_MEMORY, LOBE_ERROR_OUT_OF_DEVICE_MEMORY),
    MEANING(VK_ERROR_FRAGMENTED_POOL, LOBE_ERROR_OUT_OF_DEVICE_MEMORY),
    MEANING(VK_ERROR_TOO_MANY_OBJECTS, LOBE_ERROR_LIMIT),
    MEANING(VK_ERROR_DEVICE_LOST, LOBE_ERROR_DEVICE_LOST),
    MEANING(VK_ERROR_INITIALIZATION_FAILED, LOBE_ERROR_NO_DEVICE),
    MEANING(VK_ERROR_INCOMPATIBLE_DRIVER, LOBE_ERROR_NO_DEVICE),
    MEANING(VK_ERROR_LAYER_NOT_PRESENT, LOBE_ERROR_UNSUPPORTED),
    MEANING(VK_ERROR_EXTENSION_NOT_PRESENT, LOBE_ERROR_UNSUPPORTED),
    MEANING(VK_ERROR_FEATURE_NOT_PRESENT, LOBE_ERROR_UNSUPPORTED),
    MEANING(VK_ERROR_FORMAT_NOT_SUPPORTED, LOBE_ERROR_UNSUPPORTED),
    MEANING(VK_ERROR_INVALID_SHADER_NV, LOBE_ERROR_SHADER),
    MEANING(VK_ERROR_SURFACE_LOST_KHR, LOBE_ERROR_UNSUPPORTED),
    MEANING(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR, LOBE_ERROR_UNSUPPORTED),
    MEANING(VK_ERROR_OUT_OF_DATE_KHR, LOBE_ERROR_UNSUPPORTED),
    MEANING(VK_SUBOPTIMAL_KHR, LOBE_OK),
};

static const vulkan_result_meaning *meaning_of(VkResult result) {
    static const vulkan_result_meaning unknown = {VK_ERROR_UNKNOWN, "an unknown Vulkan error",
                                                  LOBE_ERROR_UNSUPPORTED};
    for (size_t i = 0; i < sizeof meanings / sizeof *meanings; i++)
        if (meanings[i].vulkan == result)
            return &meanings[i];
    return &unknown;
}

lobe_result engine_vulkan_result(VkResult result) {
    return meaning_of(result)->meaning;
}

lobe_result engine_vulkan_check(const lobe_host *host, VkResult vulkan, const char *expression,
                                const char *format, ...) {
    const lobe_result result = engine_vulkan_result(vulkan);
    if (result == LOBE_OK || !host)
        return result;
    char purpose[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(purpose, sizeof purpose, format, arguments);
    va_end(arguments);
    // Only the function's name: "vkCreateImage" of "device->api.vkCreateImage(…)".
    const char *name = expression, *end = expression;
    for (; *end && *end != '('; end++)
        if (*end == '.' || *end == '>')
            name = end + 1;
    return lobe_host_fail(host, result, "%s: %.*s gave %s", purpose, (int)(end - name), name,
                          meaning_of(vulkan)->name);
}
