#include "engine/device/vulkan_functions.h"

#include <dlfcn.h>

#define LOADER "libvulkan.so.1"

static PFN_vkGetInstanceProcAddr open_library(void) {
    // Never unloaded: drivers and layers leave threads and per-thread data behind.
    void *library = dlopen(LOADER, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!library)
        return NULL;
    const PFN_vkGetInstanceProcAddr found =
        (PFN_vkGetInstanceProcAddr)dlsym(library, "vkGetInstanceProcAddr");
    dlclose(library);
    return found;
}

static lobe_result check_found(const lobe_host *host, const char *of, const char *missing) {
    return missing
               ? lobe_host_fail(host, LOBE_ERROR_NO_DEVICE, "the Vulkan %s lacks %s", of, missing)
               : LOBE_OK;
}

lobe_result engine_loader_open(const lobe_host *host,
                               PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                               engine_instance_api *api) {
    *api = (engine_instance_api){
        .vkGetInstanceProcAddr = get_instance_proc_addr ? get_instance_proc_addr : open_library(),
    };
    if (!api->vkGetInstanceProcAddr)
        return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE,
                              "Vulkan loader " LOADER " not found: install libvulkan1");
    const char *missing = NULL;
#define FIND(function)                                                                             \
    api->function = (PFN_##function)api->vkGetInstanceProcAddr(NULL, #function);                   \
    if (!api->function)                                                                            \
        missing = #function;
    ENGINE_LOADER_FUNCTIONS(FIND)
#undef FIND
    return check_found(host, "loader", missing);
}

lobe_result engine_instance_api_load(const lobe_host *host, VkInstance instance, bool debug_utils,
                                     engine_instance_api *api) {
    const char *missing = NULL;
#define FIND(function)                                                                             \
    api->function = (PFN_##function)api->vkGetInstanceProcAddr(instance, #function);               \
    if (!api->function)                                                                            \
        missing = #function;
    ENGINE_INSTANCE_FUNCTIONS(FIND)
    if (debug_utils) {
        ENGINE_DEBUG_FUNCTIONS(FIND)
    }
#undef FIND
    return check_found(host, "instance", missing);
}

lobe_result engine_device_api_load(const lobe_host *host, const engine_instance_api *instance,
                                   VkDevice device, engine_device_api *api) {
    const char *missing = NULL;
#define FIND(function)                                                                             \
    api->function = (PFN_##function)instance->vkGetDeviceProcAddr(device, #function);              \
    if (!api->function)                                                                            \
        missing = #function;
    ENGINE_DEVICE_FUNCTIONS(FIND)
#undef FIND
    return check_found(host, "device", missing);
}
