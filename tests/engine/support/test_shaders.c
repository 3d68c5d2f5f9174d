#include "tests/engine/support/test_shaders.h"

#include "tests/engine/support/host_device.h"

lobe_result add_test_shaders(lobe_device *device) {
    return engine_shaders_add(device, engine_test_shaders, engine_test_shaders_count,
                              TEST_SHADER_FOLDER);
}

lobe_result open_device_with_test_shaders(const lobe_host *host, const char *pipeline_cache,
                                          lobe_device **device) {
    const lobe_device_parameters parameters = {
        .validation = true,
        .pipeline_cache = pipeline_cache,
        .get_instance_proc_addr = test_vulkan_loader,
        .host = host,
    };
    const lobe_result result = lobe_device_create(&parameters, device);
    return result == LOBE_OK ? add_test_shaders(*device) : result;
}
