#include "engine/graph/declare/declare.h"

#include <lobe/vulkan.h>

#include "engine/resource/format.h"

lobe_format lobe_vulkan_format(VkFormat format) {
    for (int i = LOBE_FORMAT_NONE + 1; i < LOBE_FORMAT_COUNT; i++)
        if (engine_format_vulkan((lobe_format)i) == format)
            return (lobe_format)i;
    return LOBE_FORMAT_NONE;
}

// ---------------------------------------------------------------------------------------------
// Declaration

static uint32_t at_least_one(uint32_t value) {
    return value ? value : 1;
}

static bool overlaps(uint32_t first, uint32_t count, uint32_t other_first, uint32_t other_count) {
    return first < other_first + at_least_one(other_count) &&
           other_first < first + at_least_one(count);
}

static bool is_imported(const lobe_graph *graph, const lobe_vulkan_image *image) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        const lobe_vulkan_image *other = graph->frame.resources[i].host;
        if (other && other->image == image->image &&
            overlaps(image->first_layer, image->layers, other->first_layer, other->layers) &&
            overlaps(image->first_level, image->levels, other->first_level, other->levels))
            return true;
    }
    return false;
}

static bool check_image(lobe_graph *graph, const lobe_vulkan_image *image, const char *name) {
    if (!image->image || image->width == 0 || image->height == 0)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "host image '%s': needs a handle and an extent above 0 (%ux%u)", name,
                        image->width, image->height);
    else if (lobe_vulkan_format(image->format) == LOBE_FORMAT_NONE)
        lobe_graph_fail(graph, LOBE_ERROR_UNSUPPORTED,
                        "host image '%s': VkFormat %d is not supported", name, (int)image->format);
    else if (is_imported(graph, image))
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "host image '%s' is imported twice in one frame",
                        name);
    return graph->frame.result == LOBE_OK;
}

static engine_stamp content_of(const lobe_graph *graph, const engine_graph_resource *resource) {
    const lobe_vulkan_image *image = resource->host;
    const uint64_t numbers[] = {ENGINE_GRAPH_HOST_IMAGE, (uint64_t)(uintptr_t)image->image,
                                image->content,          resource->format,
                                resource->width,         resource->height,
                                resource->layers,        resource->levels,
                                resource->first_layer,   resource->first_level};
    return engine_graph_lent_content(graph, image->content, numbers, sizeof numbers);
}

lobe_resource lobe_graph_import_image(lobe_graph *graph, const lobe_vulkan_image *image) {
    if (!image) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "lobe_graph_import_image: image must not be NULL");
        return (lobe_resource){0};
    }
    const char *name = image->name ? image->name : "host image";
    if (!engine_graph_can_declare(graph, name) || !check_image(graph, image, name))
        return (lobe_resource){0};
    lobe_vulkan_image *kept = engine_arena_copy(&graph->frame.arena, image, sizeof *image);
    name = engine_arena_copy_text(&graph->frame.arena, name);
    if (!kept || !name) {
        engine_graph_fail_memory(graph);
        return (lobe_resource){0};
    }
    engine_graph_resource resource = {.name = name,
                                      .origin = ENGINE_GRAPH_HOST_IMAGE,
                                      .is_image = true,
                                      .format = lobe_vulkan_format(image->format),
                                      .width = image->width,
                                      .height = image->height,
                                      .layers = at_least_one(image->layers),
                                      .levels = at_least_one(image->levels),
                                      .first_layer = image->first_layer,
                                      .first_level = image->first_level,
                                      .samples = 1,
                                      .host = kept};
    bool has_content = image->layout != VK_IMAGE_LAYOUT_UNDEFINED;
    engine_dependency_resource dependency = {
        .name = name,
        .levels = resource.levels,
        .layers = resource.layers,
        .borrowed = true,
        .identity = content_of(graph, &resource),
        .before = {.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   .access = VK_ACCESS_2_MEMORY_WRITE_BIT,
                   .layout = has_content ? ENGINE_LAYOUT_LENT : ENGINE_LAYOUT_UNDEFINED},
        .after = engine_graph_returned_state(image->final_stages, image->final_access)};
    return engine_graph_add_resource(graph, &resource, &dependency);
}

// ---------------------------------------------------------------------------------------------
// Compilation

static const char *missing_usage(VkImageUsageFlags missing) {
    if (missing & VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)
        return "colour attachment";
    if (missing & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT)
        return "depth attachment";
    if (missing & VK_IMAGE_USAGE_SAMPLED_BIT)
        return "sampled";
    if (missing & VK_IMAGE_USAGE_STORAGE_BIT)
        return "storage";
    return missing & VK_IMAGE_USAGE_TRANSFER_SRC_BIT ? "transfer source" : "transfer destination";
}

lobe_result engine_graph_check_host_images(lobe_graph *graph) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        const engine_graph_resource *resource = &graph->frame.resources[i];
        VkFlags missing = resource->host ? resource->usage & ~resource->host->usage : 0;
        if (missing)
            return lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                                   "host image '%s' was not created with the usage '%s'",
                                   resource->name, missing_usage(missing));
    }
    return LOBE_OK;
}
