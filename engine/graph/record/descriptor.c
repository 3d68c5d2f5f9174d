#include "engine/graph/record/record.h"

#include "engine/base/growing_array.h"
#include "engine/device/vulkan_check.h"
#include "engine/graph/declare/declare.h"
#include "engine/graph/store/store.h"
#include "engine/pipeline/pipelines.h"

static const VkDescriptorType types[] = {
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
    VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
};
#define TYPE_COUNT (sizeof types / sizeof *types)
_Static_assert(sizeof((engine_graph_flight *)0)->descriptor_capacity ==
                   (1 + TYPE_COUNT) * sizeof(uint32_t),
               "a capacity for the sets and for each type");

// ---------------------------------------------------------------------------------------------
// Which commands need a set

/// Walks the commands of running passes that have a pipeline. Starts zeroed.
typedef struct command_walk {
    uint32_t position;
    lobe_pass *pass;
    engine_graph_command *command;
    bool shares_set; ///< with the previous command
} command_walk;

/// Consecutive draws with the same pipeline and no bindings of their own share a set.
static bool can_share_set(const engine_graph_command *command, const engine_graph_command *before) {
    return before->pipeline == command->pipeline && !before->bindings.first &&
           !command->bindings.first;
}

static bool next_command(const lobe_graph *graph, command_walk *walk) {
    const engine_graph_command *before = walk->command;
    engine_graph_command *command = before ? before->next : NULL;
    while (!command || !command->pipeline) {
        if (command) {
            command = command->next;
            continue;
        }
        if (walk->position == graph->frame.dependencies.running_count)
            return false;
        walk->pass = graph->frame.passes[graph->frame.dependencies.running[walk->position++]];
        command = walk->pass->first_command;
        before = NULL;
    }
    walk->command = command;
    walk->shares_set = before && can_share_set(command, before);
    return true;
}

/// What the sets of this frame's commands need.
typedef struct set_needs {
    uint32_t counts[1 + TYPE_COUNT]; ///< sets, then descriptors by type
    uint32_t variables;
    engine_stamp plan; ///< digest of the pipelines, whose layouts the sets have
} set_needs;

static set_needs count_needs(const lobe_graph *graph) {
    set_needs needs = {.plan = engine_stamp_mix(ENGINE_STAMP_NONE, 0)};
    for (command_walk walk = {0}; next_command(graph, &walk);) {
        const engine_pipeline *pipeline = walk.command->pipeline;
        if (walk.shares_set)
            continue;
        needs.counts[0]++;
        needs.variables += (uint32_t)pipeline->binding_count;
        needs.plan = engine_stamp_mix(needs.plan, pipeline->stamp);
        for (size_t i = 0; i < pipeline->binding_count; i++)
            for (size_t type = 0; type < TYPE_COUNT; type++)
                if (pipeline->bindings[i].type == types[type])
                    needs.counts[1 + type] += pipeline->bindings[i].count;
    }
    return needs;
}

// ---------------------------------------------------------------------------------------------
// The pool

static lobe_result create_pool(lobe_graph *graph) {
    lobe_device *device = graph->device;
    VkDescriptorPoolSize sizes[TYPE_COUNT];
    uint32_t used = 0;
    for (size_t i = 0; i < TYPE_COUNT; i++)
        if (graph->frame.flight->descriptor_capacity[1 + i] > 0)
            sizes[used++] =
                (VkDescriptorPoolSize){types[i], graph->frame.flight->descriptor_capacity[1 + i]};
    const VkDescriptorPoolCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = graph->frame.flight->descriptor_capacity[0],
        .poolSizeCount = used,
        .pPoolSizes = sizes,
    };
    return VULKAN_CHECK(&device->host,
                        device->api.vkCreateDescriptorPool(device->vulkan, &create,
                                                           device->callbacks,
                                                           &graph->frame.flight->descriptors),
                        "render graph");
}

/// Empties the pool, or replaces it by a larger one if it is too small for this frame.
static lobe_result prepare_pool(lobe_graph *graph, const set_needs *needs) {
    lobe_device *device = graph->device;
    engine_graph_flight *flight = graph->frame.flight;
    bool large_enough = flight->descriptors != VK_NULL_HANDLE;
    for (size_t i = 0; i < 1 + TYPE_COUNT; i++)
        if (needs->counts[i] > flight->descriptor_capacity[i]) {
            flight->descriptor_capacity[i] = needs->counts[i];
            large_enough = false;
        }
    if (large_enough)
        return VULKAN_CHECK(
            &device->host,
            device->api.vkResetDescriptorPool(device->vulkan, flight->descriptors, 0),
            "render graph");
    device->api.vkDestroyDescriptorPool(device->vulkan, flight->descriptors, device->callbacks);
    flight->descriptors = VK_NULL_HANDLE;
    return create_pool(graph);
}

// ---------------------------------------------------------------------------------------------
// Sets

static lobe_result allocate_sets(lobe_graph *graph, uint32_t count) {
    engine_graph_flight *flight = graph->frame.flight;
    uint32_t filled = 0;
    VkDescriptorSetLayout *layouts =
        engine_arena_allocate(&graph->frame.arena, count * sizeof *layouts);
    if (!layouts || !engine_array_reserve(graph->device->host.allocator, (void **)&flight->sets,
                                          &flight->set_capacity, count, sizeof *flight->sets))
        return engine_graph_fail_memory(graph);
    for (command_walk walk = {0}; next_command(graph, &walk);)
        if (!walk.shares_set)
            layouts[filled++] = walk.command->pipeline->set_layout;
    const VkDescriptorSetAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = flight->descriptors,
        .descriptorSetCount = count,
        .pSetLayouts = layouts,
    };
    return VULKAN_CHECK(
        &graph->device->host,
        graph->device->api.vkAllocateDescriptorSets(graph->device->vulkan, &allocate, flight->sets),
        "render graph");
}

/// Reuses the sets of the flight's last frame if this frame needs exactly the same.
static lobe_result prepare_sets(lobe_graph *graph, const set_needs *needs) {
    if (graph->frame.flight->set_plan == needs->plan || needs->counts[0] == 0)
        return LOBE_OK;
    graph->frame.flight->set_plan = ENGINE_STAMP_NONE;
    lobe_result result = prepare_pool(graph, needs);
    if (result == LOBE_OK)
        result = allocate_sets(graph, needs->counts[0]);
    if (result == LOBE_OK)
        graph->frame.flight->set_plan = needs->plan;
    return result;
}

static void assign_sets(const lobe_graph *graph) {
    uint32_t next = 0;
    for (command_walk walk = {0}; next_command(graph, &walk);) {
        next += !walk.shares_set;
        walk.command->set = graph->frame.flight->sets[next - 1];
    }
}

// ---------------------------------------------------------------------------------------------
// Content of the sets

/// Writes to all sets of a frame, made in one call; each has an image or a buffer.
typedef struct write_batch {
    VkWriteDescriptorSet *writes;
    VkDescriptorImageInfo *images;
    VkDescriptorBufferInfo *buffers;
    uint32_t count;
} write_batch;

static bool create_batch(engine_arena *arena, uint32_t count, write_batch *batch) {
    *batch = (write_batch){.writes = engine_arena_allocate(arena, count * sizeof *batch->writes),
                           .images = engine_arena_allocate(arena, count * sizeof *batch->images),
                           .buffers = engine_arena_allocate(arena, count * sizeof *batch->buffers)};
    return batch->writes && batch->images && batch->buffers;
}

static VkDescriptorBufferInfo describe_block(const engine_graph_resource *resource,
                                             const engine_shader_binding *variable) {
    // Uniform blocks are limited in size, unlike the buffers that contain them.
    bool uniform = variable->type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    return (VkDescriptorBufferInfo){.buffer = resource->object->buffer,
                                    .offset = resource->offset,
                                    .range = uniform ? variable->size : resource->size};
}

static lobe_result describe_image(lobe_graph *graph, const engine_graph_resource *resource,
                                  const engine_graph_binding *binding,
                                  const engine_shader_binding *variable,
                                  VkDescriptorImageInfo *image) {
    const engine_dependency_access *access = &graph->frame.dependencies.accesses[binding->access];
    image->imageLayout = engine_graph_vulkan_layout(access->state.layout);
    lobe_result result = engine_graph_get_view(graph->device, resource, variable->view,
                                               &access->range, &image->imageView);
    if (result == LOBE_OK && variable->type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)
        result = engine_sampler(graph->device, &binding->sampler, &image->sampler);
    return result;
}

lobe_result engine_graph_describe(lobe_graph *graph, const engine_graph_binding *binding,
                                  const engine_shader_binding *variable,
                                  VkDescriptorImageInfo *image, VkDescriptorBufferInfo *buffer) {
    const engine_graph_resource *resource =
        &graph->frame.resources[graph->frame.dependencies.accesses[binding->access].resource];
    if (resource->is_image)
        return describe_image(graph, resource, binding, variable, image);
    *buffer = describe_block(resource, variable);
    return LOBE_OK;
}

static lobe_result add_variable(lobe_graph *graph, const command_walk *walk,
                                const engine_shader_binding *variable, write_batch *batch) {
    const engine_graph_binding *binding =
        engine_graph_find_binding(walk->pass, walk->command, variable->name);
    uint32_t n = batch->count++;
    batch->writes[n] = (VkWriteDescriptorSet){
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = walk->command->set,
        .dstBinding = variable->binding,
        .descriptorCount = 1,
        .descriptorType = variable->type,
        .pImageInfo = &batch->images[n],
        .pBufferInfo = &batch->buffers[n],
    };
    return engine_graph_describe(graph, binding, variable, &batch->images[n], &batch->buffers[n]);
}

static lobe_result write_sets(lobe_graph *graph, uint32_t variables) {
    write_batch batch;
    lobe_result result = LOBE_OK;
    if (!create_batch(&graph->frame.arena, variables, &batch))
        return engine_graph_fail_memory(graph);
    for (command_walk walk = {0}; next_command(graph, &walk);)
        for (size_t i = 0; !walk.shares_set && i < walk.command->pipeline->binding_count; i++) {
            result = add_variable(graph, &walk, &walk.command->pipeline->bindings[i], &batch);
            if (result != LOBE_OK)
                return result;
        }
    graph->device->api.vkUpdateDescriptorSets(graph->device->vulkan, batch.count, batch.writes, 0,
                                              NULL);
    return LOBE_OK;
}

lobe_result engine_graph_write_descriptors(lobe_graph *graph) {
    const set_needs needs = count_needs(graph);
    lobe_result result = prepare_sets(graph, &needs);
    if (result != LOBE_OK)
        return result;
    assign_sets(graph);
    return write_sets(graph, needs.variables);
}
