#include "engine/graph_descriptor.h"

#include <string.h>

#include "engine/graph_binding.h"
#include "engine/graph_object.h"
#include "engine/vulkan_check.h"

static const VkDescriptorType types[] = {
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
};
#define TYPE_COUNT (sizeof types / sizeof *types)

VkImageLayout engine_graph_vulkan_layout(engine_layout layout) {
    switch (layout) {
    case ENGINE_LAYOUT_GENERAL:
        return VK_IMAGE_LAYOUT_GENERAL;
    case ENGINE_LAYOUT_SAMPLED:
        return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    case ENGINE_LAYOUT_COLOUR:
        return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    case ENGINE_LAYOUT_DEPTH:
        return VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    case ENGINE_LAYOUT_COPY_SOURCE:
        return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case ENGINE_LAYOUT_COPY_TARGET:
        return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    default:
        return VK_IMAGE_LAYOUT_UNDEFINED;
    }
}

// ---------------------------------------------------------------------------------------------
// The pool

/// Commands of running passes that have a pipeline, one after the other. Start with zero.
typedef struct command_walk {
    uint32_t position;
    lobe_pass *pass;
    engine_graph_command *command;
} command_walk;

static bool next_command(const lobe_graph *graph, command_walk *walk) {
    if (walk->command)
        walk->command = walk->command->next;
    while (!walk->command || !walk->command->pipeline) {
        if (walk->command) {
            walk->command = walk->command->next;
            continue;
        }
        if (walk->position == graph->dependencies.running_count)
            return false;
        walk->pass = graph->passes[graph->dependencies.running[walk->position++]];
        walk->command = walk->pass->first_command;
    }
    return true;
}

static void count_descriptors(const lobe_graph *graph, uint32_t counts[1 + TYPE_COUNT]) {
    for (command_walk walk = {0}; next_command(graph, &walk);) {
        const engine_pipeline *pipeline = walk.command->pipeline;
        counts[0]++;
        for (size_t n = 0; n < pipeline->binding_count; n++)
            for (size_t type = 0; type < TYPE_COUNT; type++)
                if (pipeline->bindings[n].type == types[type])
                    counts[1 + type] += pipeline->bindings[n].count;
    }
}

static lobe_result create_pool(lobe_graph *graph) {
    lobe_device *device = graph->device;
    VkDescriptorPoolSize sizes[TYPE_COUNT];
    uint32_t used = 0;
    for (size_t n = 0; n < TYPE_COUNT; n++)
        if (graph->flight->descriptor_capacity[1 + n] > 0)
            sizes[used++] =
                (VkDescriptorPoolSize){types[n], graph->flight->descriptor_capacity[1 + n]};
    const VkDescriptorPoolCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = graph->flight->descriptor_capacity[0],
        .poolSizeCount = used,
        .pPoolSizes = sizes,
    };
    return VULKAN_CHECK(&device->log,
                        vkCreateDescriptorPool(device->vulkan, &create, device->callbacks,
                                               &graph->flight->descriptors),
                        "render graph");
}

/// Empties the pool; makes a larger one where it is too small for this frame.
static lobe_result prepare_pool(lobe_graph *graph) {
    lobe_device *device = graph->device;
    uint32_t counts[1 + TYPE_COUNT] = {0};
    bool large_enough = graph->flight->descriptors != VK_NULL_HANDLE;
    count_descriptors(graph, counts);
    for (size_t n = 0; n < 1 + TYPE_COUNT; n++)
        if (counts[n] > graph->flight->descriptor_capacity[n]) {
            graph->flight->descriptor_capacity[n] = counts[n];
            large_enough = false;
        }
    if (large_enough || counts[0] == 0)
        return graph->flight->descriptors == VK_NULL_HANDLE
                   ? LOBE_OK
                   : VULKAN_CHECK(
                         &device->log,
                         vkResetDescriptorPool(device->vulkan, graph->flight->descriptors, 0),
                         "render graph");
    vkDestroyDescriptorPool(device->vulkan, graph->flight->descriptors, device->callbacks);
    graph->flight->descriptors = VK_NULL_HANDLE;
    return create_pool(graph);
}

// ---------------------------------------------------------------------------------------------
// Sets

static lobe_result allocate_set(lobe_graph *graph, engine_graph_command *command) {
    const VkDescriptorSetAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = graph->flight->descriptors,
        .descriptorSetCount = 1,
        .pSetLayouts = &command->pipeline->set_layout,
    };
    return VULKAN_CHECK(&graph->device->log,
                        vkAllocateDescriptorSets(graph->device->vulkan, &allocate, &command->set),
                        "render graph, '%s'", command->pipeline->name);
}

static lobe_result write_block(lobe_graph *graph, const engine_graph_resource *resource,
                               const engine_shader_binding *variable, VkWriteDescriptorSet *write) {
    // Uniform blocks are limited in size, the buffers they lie in are not.
    bool uniform = variable->type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    const VkDescriptorBufferInfo buffer = {.buffer = resource->object->buffer,
                                           .offset = resource->offset,
                                           .range = uniform ? variable->size : resource->size};
    write->pBufferInfo = &buffer;
    vkUpdateDescriptorSets(graph->device->vulkan, 1, write, 0, NULL);
    return LOBE_OK;
}

static lobe_result write_image(lobe_graph *graph, const engine_graph_resource *resource,
                               const engine_graph_binding *binding,
                               const engine_shader_binding *variable, VkWriteDescriptorSet *write) {
    const engine_dependency_access *access = &graph->dependencies.accesses[binding->access];
    VkDescriptorImageInfo image = {.imageLayout = engine_graph_vulkan_layout(access->state.layout)};
    lobe_result result = engine_graph_view_of(graph->device, resource, variable->view,
                                              &access->range, &image.imageView);
    if (result == LOBE_OK && variable->type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)
        result = engine_sampler(graph->device, &binding->sampler, &image.sampler);
    if (result != LOBE_OK)
        return result;
    write->pImageInfo = &image;
    vkUpdateDescriptorSets(graph->device->vulkan, 1, write, 0, NULL);
    return LOBE_OK;
}

static lobe_result write_variable(lobe_graph *graph, const lobe_pass *pass,
                                  const engine_graph_command *command,
                                  const engine_shader_binding *variable) {
    const engine_graph_binding *binding = engine_graph_bound(pass, command, variable->name);
    if (!binding)
        return LOBE_OK; // no code of the shader refers to it
    const engine_graph_resource *resource =
        &graph->resources[graph->dependencies.accesses[binding->access].resource];
    VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = command->set,
        .dstBinding = variable->binding,
        .descriptorCount = 1,
        .descriptorType = variable->type,
    };
    bool block = variable->type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
                 variable->type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    return block ? write_block(graph, resource, variable, &write)
                 : write_image(graph, resource, binding, variable, &write);
}

/// Draws that follow one another with the same pipeline and no bindings of their own share a set.
static bool shares_set(const engine_graph_command *command, const engine_graph_command *before) {
    return before && before->pipeline == command->pipeline && !before->bindings.first &&
           !command->bindings.first;
}

static lobe_result write_set(lobe_graph *graph, const lobe_pass *pass,
                             engine_graph_command *command) {
    lobe_result result = allocate_set(graph, command);
    for (size_t n = 0; result == LOBE_OK && n < command->pipeline->binding_count; n++)
        result = write_variable(graph, pass, command, &command->pipeline->bindings[n]);
    return result;
}

lobe_result engine_graph_write_descriptors(lobe_graph *graph) {
    lobe_result result = prepare_pool(graph);
    const lobe_pass *pass = NULL;
    const engine_graph_command *before = NULL;
    for (command_walk walk = {0}; result == LOBE_OK && next_command(graph, &walk);) {
        if (walk.pass != pass)
            before = NULL;
        if (shares_set(walk.command, before))
            walk.command->set = before->set;
        else
            result = write_set(graph, walk.pass, walk.command);
        pass = walk.pass;
        before = walk.command;
    }
    return result;
}
