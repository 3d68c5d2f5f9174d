#include "engine/pipeline/module.h"

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "third_party/spirv_tools.h"

typedef struct module_creation {
    lobe_device *device;
    const engine_shader *shader;
    lobe_result result;
    VkShaderModule module;
} module_creation;

static void create(void *user, const uint32_t *words, size_t count) {
    module_creation *creation = user;
    lobe_device *device = creation->device;
    const VkShaderModuleCreateInfo information = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = count * sizeof *words,
        .pCode = words,
    };
    creation->result =
        VULKAN_CHECK(&device->host,
                     device->api.vkCreateShaderModule(device->vulkan, &information,
                                                      device->callbacks, &creation->module),
                     "shader '%s'", creation->shader->name);
    if (creation->result == LOBE_OK)
        engine_device_name(device, VK_OBJECT_TYPE_SHADER_MODULE, (uint64_t)creation->module,
                           creation->shader->name);
}

/// `constants` has room for `count`.
static void specialise(module_creation *creation, const lobe_specialisation *values, size_t count,
                       spirv_constant *constants) {
    for (size_t i = 0; i < count; i++)
        constants[i] = (spirv_constant){values[i].id, values[i].bits};
    const spirv_source source = {
        .words = creation->shader->words,
        .count = creation->shader->word_count,
        .constants = constants,
        .constant_count = count,
        .take = create,
        .user = creation,
    };
    char message[SPIRV_MESSAGE_SIZE];
    if (!third_party_spirv_specialise(&source, message))
        creation->result = lobe_host_fail(&creation->device->host, LOBE_ERROR_SHADER,
                                          "shader '%s' cannot be specialised: %s",
                                          creation->shader->name, message);
}

lobe_result engine_module_create(lobe_device *device, const engine_shader *shader,
                                 const lobe_specialisation *values, size_t count,
                                 VkShaderModule *module) {
    module_creation creation = {.device = device, .shader = shader};
    *module = VK_NULL_HANDLE;
    if (shader->specialisation_count == 0) {
        create(&creation, shader->words, shader->word_count);
        *module = creation.module;
        return creation.result;
    }
    spirv_constant *constants = lobe_allocate(device->host.allocator, count + 1, sizeof *constants);
    if (!constants)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "shader '%s': out of memory",
                              shader->name);
    specialise(&creation, values, count, constants);
    lobe_release(constants);
    *module = creation.module;
    return creation.result;
}
