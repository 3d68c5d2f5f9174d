#include "engine/device/features.h"

#include <string.h>

#define CORE       core.features
#define VULKAN_1_2 vulkan_1_2
#define VULKAN_1_3 vulkan_1_3

/// The features that lobe knows: the structure that holds it, its name, whether it is required, its
/// use. Every Vulkan 1.3 device has the required ones.
#define KNOWN_FEATURES(X)                                                                          \
    X(VULKAN_1_3, dynamicRendering, true, "raster passes without render pass objects")             \
    X(VULKAN_1_3, synchronization2, true, "barriers of the render graph")                          \
    X(VULKAN_1_2, timelineSemaphore, true, "detecting when a frame is done")                       \
    X(VULKAN_1_2, uniformBufferStandardLayout, true, "structures shared by C and GLSL")            \
    X(VULKAN_1_3, maintenance4, true, "group sizes set by specialisation")                         \
    X(VULKAN_1_3, shaderDemoteToHelperInvocation, true, "discarding fragments before derivatives") \
    X(VULKAN_1_3, shaderTerminateInvocation, true, "discarding fragments")                         \
    X(CORE, samplerAnisotropy, false, "anisotropic texture filtering")                             \
    X(CORE, shaderStorageImageExtendedFormats, false, "writing one- and two-channel images")       \
    X(CORE, fragmentStoresAndAtomics, false, "fragment shaders that write buffers")                \
    X(CORE, vertexPipelineStoresAndAtomics, false, "vertex shaders that write buffers")            \
    X(CORE, independentBlend, false, "several colour outputs with blending")

#define DESCRIPTION(place, field, required, use) {#field, use, required, false},
#define OFFSET(place, field, required, use)      offsetof(lobe_vulkan_features, place.field),

static const lobe_device_feature known[] = {KNOWN_FEATURES(DESCRIPTION)};
static const size_t offsets[] = {KNOWN_FEATURES(OFFSET)}; ///< of each one's VkBool32

_Static_assert(sizeof known / sizeof *known == ENGINE_FEATURE_COUNT, "keep the count");

static void chain(lobe_vulkan_features *features) {
    *features = (lobe_vulkan_features){
        .core = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                 .pNext = &features->vulkan_1_1},
        .vulkan_1_1 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES,
                       .pNext = &features->vulkan_1_2},
        .vulkan_1_2 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                       .pNext = &features->vulkan_1_3},
        .vulkan_1_3 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES},
    };
}

static VkBool32 *flag_of(lobe_vulkan_features *features, size_t index) {
    return (VkBool32 *)((char *)features + offsets[index]);
}

static void list_present(lobe_vulkan_features *present,
                         lobe_device_feature features[ENGINE_FEATURE_COUNT]) {
    for (size_t i = 0; i < ENGINE_FEATURE_COUNT; i++) {
        features[i] = known[i];
        features[i].present = *flag_of(present, i);
    }
}

const lobe_device_feature *lobe_vulkan_feature_list(size_t *count) {
    if (!count)
        return known;
    *count = ENGINE_FEATURE_COUNT;
    return known;
}

void engine_features_query(const engine_instance_api *api, VkPhysicalDevice physical,
                           lobe_device_feature features[ENGINE_FEATURE_COUNT]) {
    lobe_vulkan_features present;
    chain(&present);
    api->vkGetPhysicalDeviceFeatures2(physical, &present.core);
    list_present(&present, features);
}

void engine_features_enable(const lobe_device_feature features[ENGINE_FEATURE_COUNT],
                            lobe_vulkan_features *enable) {
    chain(enable);
    for (size_t i = 0; i < ENGINE_FEATURE_COUNT; i++)
        *flag_of(enable, i) = features[i].present;
}

// ---------------------------------------------------------------------------------------------
// What a host enabled

/// A structure that holds a single known feature, used instead of Vulkan 1.2's or 1.3's.
typedef struct single_feature {
    VkStructureType type;
    size_t offset; ///< of its VkBool32 in lobe_vulkan_features
} single_feature;

#define SINGLE(type, place)                                                                        \
    { VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_##type##_FEATURES, offsetof(lobe_vulkan_features, place) }

static const single_feature singles[] = {
    SINGLE(DYNAMIC_RENDERING, vulkan_1_3.dynamicRendering),
    SINGLE(SYNCHRONIZATION_2, vulkan_1_3.synchronization2),
    SINGLE(TIMELINE_SEMAPHORE, vulkan_1_2.timelineSemaphore),
    SINGLE(UNIFORM_BUFFER_STANDARD_LAYOUT, vulkan_1_2.uniformBufferStandardLayout),
    SINGLE(MAINTENANCE_4, vulkan_1_3.maintenance4),
    SINGLE(SHADER_DEMOTE_TO_HELPER_INVOCATION, vulkan_1_3.shaderDemoteToHelperInvocation),
    SINGLE(SHADER_TERMINATE_INVOCATION, vulkan_1_3.shaderTerminateInvocation),
};

static void read_single(const VkBaseInStructure *structure, lobe_vulkan_features *features) {
    for (size_t i = 0; i < sizeof singles / sizeof *singles; i++)
        if (singles[i].type == structure->sType)
            // All of them have one VkBool32 after the header.
            memcpy((char *)features + singles[i].offset, structure + 1, sizeof(VkBool32));
}

static void read_structure(const VkBaseInStructure *structure, lobe_vulkan_features *features) {
    switch (structure->sType) {
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES:
        memcpy(&features->vulkan_1_1, structure, sizeof features->vulkan_1_1);
        break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES:
        memcpy(&features->vulkan_1_2, structure, sizeof features->vulkan_1_2);
        break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES:
        memcpy(&features->vulkan_1_3, structure, sizeof features->vulkan_1_3);
        break;
    default:
        read_single(structure, features);
        break;
    }
}

void engine_features_read(const VkPhysicalDeviceFeatures2 *enabled,
                          lobe_device_feature features[ENGINE_FEATURE_COUNT]) {
    lobe_vulkan_features found = {.core.features = enabled->features};
    for (const VkBaseInStructure *next = enabled->pNext; next; next = next->pNext)
        read_structure(next, &found);
    list_present(&found, features);
}

const lobe_device_feature *
engine_features_missing(const lobe_device_feature features[ENGINE_FEATURE_COUNT]) {
    for (size_t i = 0; i < ENGINE_FEATURE_COUNT; i++)
        if (features[i].required && !features[i].present)
            return &features[i];
    return NULL;
}
