#ifndef TESTS_PASSES_OWN_SHADING_HOST_EVALUATION_H
#define TESTS_PASSES_OWN_SHADING_HOST_EVALUATION_H

#include <lobe/maps.h>

#include "tests/engine/support/host_device.h"

/// A compute shader of a host that includes lobe's, and reads and writes one buffer (set 0, binding
/// 0). lobe's descriptors are set 1.
typedef struct host_shader {
    const uint32_t *words;
    size_t size; ///< bytes
    uint32_t constant_base;
    uint32_t groups;
} host_shader;

/// What a host keeps from one run to the next; all zero before the first.
typedef struct host_evaluation {
    host_device *host;
    host_buffer data;
    VkDescriptorPool pool;
    VkDescriptorSetLayout set_layouts[2];
    VkDescriptorSet sets[2];
    VkPipelineLayout layout;
    VkPipeline pipeline;
} host_evaluation;

/// Filters and evaluates in one command buffer, with the first material's maps. The buffer has
/// `data` before, and `data` what is in it after. Asserts that everything succeeds.
void host_evaluation_run(host_evaluation *e, host_device *host, lobe_maps *maps,
                         const host_shader *shader, void *data, size_t size);
void host_evaluation_end(host_evaluation *e);

#endif
