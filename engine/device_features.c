#include "engine/device_features.h"

#include <string.h>

typedef struct known_feature {
    const char *name, *use;
    bool required;
    size_t offset; ///< of its VkBool32 in engine_features
} known_feature;

#define CORE(field, required, use)                                                                 \
    { #field, use, required, offsetof(engine_features, core.features.field) }
#define VULKAN_1_2(field, required, use)                                                           \
    { #field, use, required, offsetof(engine_features, vulkan_1_2.field) }
#define VULKAN_1_3(field, required, use)                                                           \
    { #field, use, required, offsetof(engine_features, vulkan_1_3.field) }

// The first group is part of every Vulkan 1.3 device.
static const known_feature known[] = {
    VULKAN_1_3(dynamicRendering, true, "raster passes without render pass objects"),
    VULKAN_1_3(synchronization2, true, "barriers of the render graph"),
    VULKAN_1_2(timelineSemaphore, true, "knowing when a frame is done"),
    VULKAN_1_2(uniformBufferStandardLayout, true, "structures shared by C and GLSL"),
    VULKAN_1_3(maintenance4, true, "group sizes set by specialisation"),
    VULKAN_1_3(shaderDemoteToHelperInvocation, true, "discarding fragments before derivatives"),
    VULKAN_1_3(shaderTerminateInvocation, true, "discarding fragments"),
    CORE(samplerAnisotropy, false, "anisotropic texture filtering"),
    CORE(shaderStorageImageExtendedFormats, false, "writing one- and two-channel images"),
    CORE(fragmentStoresAndAtomics, false, "fragment shaders that write buffers"),
    CORE(vertexPipelineStoresAndAtomics, false, "vertex shaders that write buffers"),
    CORE(independentBlend, false, "several colour outputs with blending"),
};

_Static_assert(sizeof known / sizeof *known == ENGINE_FEATURE_COUNT, "keep the count");

static void chain(engine_features *features) {
    *features = (engine_features){
        .core = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                 .pNext = &features->vulkan_1_1},
        .vulkan_1_1 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES,
                       .pNext = &features->vulkan_1_2},
        .vulkan_1_2 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                       .pNext = &features->vulkan_1_3},
        .vulkan_1_3 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES},
    };
}

static VkBool32 *flag_of(engine_features *features, const known_feature *feature) {
    return (VkBool32 *)((char *)features + feature->offset);
}

void engine_features_query(VkPhysicalDevice physical,
                           lobe_device_feature features[ENGINE_FEATURE_COUNT]) {
    engine_features present;
    chain(&present);
    vkGetPhysicalDeviceFeatures2(physical, &present.core);
    for (size_t i = 0; i < ENGINE_FEATURE_COUNT; i++)
        features[i] = (lobe_device_feature){
            .name = known[i].name,
            .use = known[i].use,
            .required = known[i].required,
            .present = *flag_of(&present, &known[i]),
        };
}

void engine_features_enable(const lobe_device_feature features[ENGINE_FEATURE_COUNT],
                            engine_features *enable) {
    chain(enable);
    for (size_t i = 0; i < ENGINE_FEATURE_COUNT; i++)
        *flag_of(enable, &known[i]) = features[i].present;
}

const lobe_device_feature *
engine_features_missing(const lobe_device_feature features[ENGINE_FEATURE_COUNT]) {
    for (size_t i = 0; i < ENGINE_FEATURE_COUNT; i++)
        if (features[i].required && !features[i].present)
            return &features[i];
    return NULL;
}
