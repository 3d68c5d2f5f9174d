#include "engine/graph/store/store.h"

#include <string.h>

#include "engine/device/vulkan_check.h"
#include "engine/resource/format.h"

void engine_graph_begin_retained(lobe_graph *graph) {
    engine_graph_publish_retained(graph); // the host has submitted the last frame by now
    for (engine_graph_retained *kept = graph->kept.retained; kept; kept = kept->next)
        kept->declared = false;
}

static void clear_content(engine_graph_retained *kept) {
    for (uint32_t i = 0; i < kept->subresource_count; i++) {
        kept->stamps[i] = ENGINE_STAMP_NONE;
        kept->layouts[i] = ENGINE_LAYOUT_UNDEFINED;
    }
}

void engine_graph_drop_retained(lobe_graph *graph, engine_graph_retained *kept) {
    engine_object object = {.shared = kept->shared,
                            .image = kept->object.image,
                            .buffer = kept->object.buffer,
                            .allocation = kept->allocation};
    engine_graph_free_views(graph->device, &kept->object);
    engine_object_destroy(graph->device, &object);
    kept->object = (engine_graph_object){0};
    kept->allocation = (engine_allocation){0};
    kept->shared = NULL;
    kept->lent = false;
    clear_content(kept);
}

static void free_retained(lobe_graph *graph, engine_graph_retained *kept) {
    engine_graph_drop_retained(graph, kept);
    lobe_release(kept->name);
    lobe_release(kept->stamps);
    lobe_release(kept->layouts);
    lobe_release(kept);
}

void engine_graph_free_retained(lobe_graph *graph) {
    while (graph->kept.retained) {
        engine_graph_retained *kept = graph->kept.retained;
        graph->kept.retained = kept->next;
        free_retained(graph, kept);
    }
}

void engine_graph_free_released(lobe_graph *graph, engine_graph_flight *flight) {
    while (flight->released) {
        engine_graph_retained *kept = flight->released;
        flight->released = kept->next;
        free_retained(graph, kept);
    }
}

/// Frames run in the order of their submission: what the last one may use goes when it has
/// finished. What was exported may be used by the host after that.
static lobe_result release(lobe_graph *graph, engine_graph_retained *kept) {
    engine_graph_flight *last = graph->kept.last;
    const bool waits = kept->exported;
    const lobe_result result = waits ? engine_graph_finish_flights(graph) : LOBE_OK;
    if (!waits && last && last->busy) {
        kept->next = last->released;
        last->released = kept;
    } else if (result == LOBE_OK) {
        free_retained(graph, kept);
    }
    return result;
}

lobe_result engine_graph_release_retained(lobe_graph *graph) {
    if (graph->frame.aside)
        return LOBE_OK;
    for (engine_graph_retained **link = &graph->kept.retained; *link;) {
        engine_graph_retained *kept = *link;
        if (kept->declared || kept->permanent) {
            link = &kept->next;
            continue;
        }
        engine_graph_retained *next = kept->next;
        const lobe_result result = release(graph, kept);
        if (result != LOBE_OK)
            return result;
        *link = next;
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Uses

/// More than this frame's uses: the content is kept, and later frames may use it in other ways.
static VkFlags lasting_usage(const lobe_graph *graph, const engine_graph_resource *resource) {
    if (!resource->is_image)
        return resource->usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
               VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
               VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkFormatProperties properties;
    graph->device->instance.api.vkGetPhysicalDeviceFormatProperties(
        graph->device->physical, engine_format_vulkan(resource->format), &properties);
    VkFlags usage = resource->usage | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                    VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (resource->samples == 1 &&
        (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT))
        usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    return usage;
}

lobe_result engine_graph_check_retained(lobe_graph *graph) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_resource *resource = &graph->frame.resources[i];
        engine_graph_retained *kept = resource->retained;
        if (resource->origin != ENGINE_GRAPH_RETAINED)
            continue;
        resource->cube =
            resource->is_image && resource->layers % 6 == 0 && resource->width == resource->height;
        if (kept && (resource->usage & ~kept->usage) == 0)
            continue;
        resource->usage = lasting_usage(graph, resource);
        if (!kept)
            continue;
        const lobe_result result = engine_graph_finish_flights(graph);
        if (result != LOBE_OK)
            return result;
        engine_graph_drop_retained(graph, kept);
        kept->usage |= resource->usage;
    }
    return LOBE_OK;
}

/// The content can still be read, but its stamp no longer equals what any pass would write.
static void invalidate(const lobe_graph *graph, engine_graph_retained *kept) {
    if (kept->permanent)
        return;
    kept->separate = true;
    if (kept->evolves)
        clear_content(kept);
    for (uint32_t i = 0; i < kept->subresource_count; i++)
        if (kept->stamps[i] != ENGINE_STAMP_NONE)
            kept->stamps[i] = engine_stamp_mix(kept->stamps[i], engine_device_stamp(graph->device));
}

void lobe_graph_invalidate(lobe_graph *graph) {
    if (!graph)
        return;
    for (engine_graph_retained *kept = graph->kept.retained; kept; kept = kept->next)
        invalidate(graph, kept);
}

void lobe_graph_invalidate_except(lobe_graph *graph, const char *prefix) {
    if (!graph || !prefix)
        return;
    for (engine_graph_retained *kept = graph->kept.retained; kept; kept = kept->next)
        if (strncmp(kept->name, prefix, strlen(prefix)) != 0)
            invalidate(graph, kept);
}

void lobe_graph_forget_buffer(lobe_graph *graph, const char *name) {
    if (!graph || !name)
        return;
    for (engine_graph_retained *kept = graph->kept.retained; kept; kept = kept->next)
        if (strcmp(kept->name, name) == 0 && kept->object.buffer)
            clear_content(kept);
}

// ---------------------------------------------------------------------------------------------
// What settles

/// Whether the device has said that the content rests, and nothing else has changed since.
/// `pending`: set to whether its answer is still to come; NULL is allowed.
static bool rests(const lobe_graph *graph, const engine_graph_retained *kept, bool *pending) {
    uint32_t answer = 0;
    const char *content = kept->asked ? lobe_graph_late_data(graph, kept->asked, pending) : NULL;
    if (content)
        memcpy(&answer, content + kept->rest_offset, sizeof answer);
    return kept->settled.rests || (answer == 1 && kept->settled.change == kept->asked_change);
}

void engine_graph_hear_of_rest(const lobe_graph *graph, engine_graph_retained *kept) {
    bool pending = false;
    kept->settled.rests = rests(graph, kept, &pending);
    if (!pending)
        kept->asked = 0;
}

static bool settles(const engine_graph_retained *kept) {
    return kept->settled.runs < kept->settles && !kept->settled.rests;
}

bool lobe_graph_settles(const lobe_graph *graph) {
    const engine_graph_retained *kept = graph ? graph->kept.retained : NULL;
    while (kept && !(kept->declared && settles(kept) && !rests(graph, kept, NULL)))
        kept = kept->next;
    return kept != NULL;
}

lobe_result engine_graph_ask_for_rest(lobe_graph *graph) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_resource *resource = &graph->frame.resources[i];
        const engine_graph_retained *kept = resource->retained;
        const uint32_t version = graph->frame.dependencies.resources[i].version;
        // Not in frames after which something else changed: in each there may be another change.
        if (kept && resource->rest_offset > 0 && version > 1 && !kept->asked && settles(kept) &&
            kept->settled.runs > 0)
            resource->asked =
                lobe_graph_read_back_late(graph, (lobe_resource){i, version}, (lobe_range){0});
    }
    return graph->frame.result;
}

// ---------------------------------------------------------------------------------------------
// Creation

static engine_graph_retained *allocate(const lobe_graph *graph, uint32_t index) {
    const engine_graph_resource *resource = &graph->frame.resources[index];
    uint32_t subresources = resource->levels * resource->layers;
    const lobe_allocator *allocator = graph->device->host.allocator;
    engine_graph_retained *kept = lobe_allocate(allocator, 1, sizeof *kept);
    if (!kept)
        return NULL;
    *kept = (engine_graph_retained){
        .name = lobe_copy_text(allocator, resource->name),
        .identity = graph->frame.dependencies.resources[index].identity,
        .usage = resource->usage,
        .subresource_count = subresources,
        .stamps = lobe_allocate(allocator, subresources, sizeof *kept->stamps),
        .layouts = lobe_allocate(allocator, subresources, sizeof *kept->layouts),
        .declared = true,
        .permanent = resource->permanent,
        .evolves = resource->evolves,
        .settles = resource->settles,
        .rest_offset = resource->rest_offset};
    if (kept->name && kept->stamps && kept->layouts)
        return kept;
    lobe_release(kept->name);
    lobe_release(kept->stamps);
    lobe_release(kept->layouts);
    lobe_release(kept);
    return NULL;
}

lobe_result engine_graph_add_retained(lobe_graph *graph, uint32_t index) {
    engine_graph_retained *kept = allocate(graph, index);
    if (!kept)
        return engine_graph_fail_memory(graph);
    kept->next = graph->kept.retained;
    graph->kept.retained = kept;
    graph->frame.resources[index].retained = kept;
    graph->frame.dependencies.resources[index].recorded = kept->stamps;
    graph->frame.dependencies.resources[index].start_layouts = kept->layouts;
    return LOBE_OK;
}

static lobe_result make_object(lobe_graph *graph, const engine_graph_resource *resource) {
    engine_graph_retained *kept = resource->retained;
    engine_memory_request request = {
        .name = resource->name, .place = ENGINE_MEMORY_DEVICE, .linear = !resource->is_image};
    engine_graph_resource lasting = *resource;
    lasting.usage = kept->usage;
    if (resource->shared &&
        !(kept->shared = engine_shared_create(graph->device, graph->kept.uploads.number)))
        return engine_graph_fail_memory(graph);
    lobe_result result =
        engine_graph_create_object(graph->device, &lasting, &kept->object, &request.requirements);
    if (result == LOBE_OK)
        result = engine_memory_allocate(graph->device->memory, &request, &kept->allocation);
    if (result == LOBE_OK)
        result = engine_graph_bind_object(graph->device, resource->name, &kept->object,
                                          &kept->allocation, 0);
    if (result != LOBE_OK)
        engine_graph_drop_retained(graph, kept);
    return result;
}

lobe_result engine_graph_place_retained(lobe_graph *graph) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_resource *resource = &graph->frame.resources[i];
        if (resource->origin != ENGINE_GRAPH_RETAINED)
            continue;
        bool needed =
            graph->frame.dependencies.resources[i].first_position != ENGINE_DEPENDENCY_NONE;
        lobe_result result = LOBE_OK;
        if (!resource->retained && needed)
            result = engine_graph_add_retained(graph, i);
        engine_graph_retained *kept = resource->retained;
        if (result == LOBE_OK && needed && !kept->object.image && !kept->object.buffer)
            result = make_object(graph, resource);
        if (result != LOBE_OK)
            return result;
        resource->object = kept ? &kept->object : NULL;
        resource->bytes = kept ? kept->allocation.size : 0;
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Content

typedef void (*visit_written)(lobe_graph *graph, uint32_t access, uint32_t subresource);

/// Every retained subresource that running passes write, in order of execution.
static void for_each_written(lobe_graph *graph, visit_written visit) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    for (uint32_t i = 0; i < dependencies->running_count; i++)
        for (uint32_t a = dependencies->passes[dependencies->running[i]].first_access;
             a != ENGINE_DEPENDENCY_NONE; a = dependencies->accesses[a].next) {
            const engine_dependency_access *access = &dependencies->accesses[a];
            if (access->kind == ENGINE_ACCESS_READ ||
                !graph->frame.resources[access->resource].retained)
                continue;
            for (uint32_t s = 0; s < engine_access_size(access); s++)
                visit(graph, a, engine_access_subresource(dependencies, access, s));
        }
}

static void clear_stamp(lobe_graph *graph, uint32_t access, uint32_t subresource) {
    uint32_t resource = graph->frame.dependencies.accesses[access].resource;
    graph->frame.resources[resource].retained->stamps[subresource] = ENGINE_STAMP_NONE;
}

void engine_graph_invalidate_retained(lobe_graph *graph) {
    for_each_written(graph, clear_stamp);
}

static void set_stamp(lobe_graph *graph, uint32_t access, uint32_t subresource) {
    uint32_t resource = graph->frame.dependencies.accesses[access].resource;
    engine_graph_retained *kept = graph->frame.resources[resource].retained;
    kept->stamps[subresource] =
        engine_dependency_content(&graph->frame.dependencies, access, resource, subresource);
    kept->settled = graph->frame.dependencies.resources[resource].settling;
}

void engine_graph_stamp_retained(lobe_graph *graph) {
    for_each_written(graph, set_stamp);
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_retained *kept = graph->frame.resources[i].retained;
        const engine_layout *layouts = graph->frame.dependencies.end_layouts +
                                       graph->frame.dependencies.resources[i].first_subresource;
        if (kept)
            memcpy(kept->layouts, layouts, kept->subresource_count * sizeof *layouts);
        if (kept && graph->frame.resources[i].asked) {
            kept->asked = graph->frame.resources[i].asked;
            kept->asked_change = kept->settled.change;
        }
    }
}
