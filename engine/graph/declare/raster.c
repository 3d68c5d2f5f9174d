#include "engine/graph/declare/declare.h"

#include <string.h>

static const engine_access_state colour_state = {
    .stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    .access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
    .layout = ENGINE_LAYOUT_COLOUR,
};

static const engine_access_state depth_state = {
    .stages =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    .access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
              VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
    .layout = ENGINE_LAYOUT_DEPTH,
};

// ---------------------------------------------------------------------------------------------
// Declaration

static bool check_slot(lobe_pass *pass, const engine_graph_attachment *slot, const char *what) {
    if (slot->access != ENGINE_DEPENDENCY_NONE)
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH, "pass '%s' has two attachments for %s",
                        pass->name, what);
    return slot->access == ENGINE_DEPENDENCY_NONE;
}

static bool check_location(lobe_pass *pass, uint32_t location) {
    const uint32_t device = lobe_device_describe(pass->graph->device)->maximum_colour_outputs;
    const uint32_t count =
        device < ENGINE_MAXIMUM_COLOUR_ATTACHMENTS ? device : ENGINE_MAXIMUM_COLOUR_ATTACHMENTS;
    if (location >= count)
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s': colour location %u is not in [0, %u]", pass->name, location,
                        count - 1);
    return location < count;
}

static bool check_format(lobe_pass *pass, const engine_graph_resource *resource, bool depth) {
    bool fits = resource->is_image && (resource->format == LOBE_FORMAT_D32_FLOAT) == depth;
    if (!fits)
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s': resource '%s' (%s) cannot be a %s attachment", pass->name,
                        resource->name,
                        resource->is_image ? lobe_format_name(resource->format) : "buffer",
                        depth ? "depth" : "colour");
    return fits;
}

static lobe_resource attach(lobe_pass *pass, engine_graph_attachment *slot,
                            const lobe_attachment *attachment, bool depth) {
    lobe_resource resource = attachment->resource;
    engine_graph_resource *target = engine_graph_find_resource(pass, resource);
    if (!target || !check_format(pass, target, depth))
        return resource;
    lobe_range range = {attachment->level, 1, attachment->layer, 1};
    engine_access_kind kind =
        attachment->load == LOBE_LOAD_KEEP ? ENGINE_ACCESS_MODIFY : ENGINE_ACCESS_WRITE;
    slot->access =
        engine_graph_add_access(pass, &resource, range, kind, depth ? depth_state : colour_state);
    slot->load = attachment->load;
    memcpy(slot->clear, attachment->clear, sizeof slot->clear);
    target->usage |=
        depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return resource;
}

lobe_resource lobe_pass_colour(lobe_pass *pass, uint32_t location,
                               const lobe_attachment *attachment) {
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_RASTER, "a colour attachment", attachment) ||
        !check_location(pass, location) ||
        !check_slot(pass, &pass->colour[location], "one colour location"))
        return attachment ? attachment->resource : (lobe_resource){0};
    return attach(pass, &pass->colour[location], attachment, false);
}

lobe_resource lobe_pass_resolve(lobe_pass *pass, uint32_t location, lobe_resource target) {
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_RASTER, "a resolve", pass) ||
        !check_location(pass, location) ||
        !check_slot(pass, &pass->resolve[location], "one resolve location"))
        return target;
    return attach(pass, &pass->resolve[location],
                  &(lobe_attachment){.resource = target, .load = LOBE_LOAD_DISCARD}, false);
}

lobe_resource lobe_pass_depth(lobe_pass *pass, const lobe_attachment *attachment) {
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_RASTER, "a depth attachment", attachment) ||
        !check_slot(pass, &pass->depth, "depth"))
        return attachment ? attachment->resource : (lobe_resource){0};
    return attach(pass, &pass->depth, attachment, true);
}

// ---------------------------------------------------------------------------------------------
// Compilation

static const engine_graph_resource *attached(const lobe_graph *graph,
                                             const engine_graph_attachment *attachment) {
    return &graph->frame.resources[graph->frame.dependencies.accesses[attachment->access].resource];
}

static VkExtent2D extent_of(const lobe_graph *graph, const engine_graph_attachment *attachment) {
    const engine_graph_resource *image = attached(graph, attachment);
    uint32_t level = graph->frame.dependencies.accesses[attachment->access].range.first_level;
    return (VkExtent2D){engine_graph_level_extent(image->width, level),
                        engine_graph_level_extent(image->height, level)};
}

/// The first attachment sets the pass's extent and sample count; the others must have the same.
static bool check_attachment(lobe_pass *pass, const engine_graph_attachment *attachment) {
    lobe_graph *graph = pass->graph;
    if (attachment->access == ENGINE_DEPENDENCY_NONE)
        return true;
    VkExtent2D extent = extent_of(graph, attachment);
    const engine_graph_resource *image = attached(graph, attachment);
    if (pass->samples == 0) {
        pass->extent = extent;
        pass->samples = image->samples;
    }
    if (extent.width != pass->extent.width || extent.height != pass->extent.height)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "pass '%s': attachment '%s' has %ux%u texels, another has %ux%u",
                        pass->name, image->name, extent.width, extent.height, pass->extent.width,
                        pass->extent.height);
    else if (image->samples != pass->samples)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "pass '%s': attachment '%s' has %u samples, another has %u", pass->name,
                        image->name, image->samples, pass->samples);
    return graph->frame.result == LOBE_OK;
}

static bool check_resolve(lobe_pass *pass, uint32_t location) {
    lobe_graph *graph = pass->graph;
    if (pass->resolve[location].access == ENGINE_DEPENDENCY_NONE)
        return true;
    const engine_graph_resource *target = attached(graph, &pass->resolve[location]);
    if (pass->colour[location].access == ENGINE_DEPENDENCY_NONE) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "pass '%s' resolves to '%s' from location %u, which has no attachment",
                        pass->name, target->name, location);
        return false;
    }
    const engine_graph_resource *source = attached(graph, &pass->colour[location]);
    VkExtent2D extent = extent_of(graph, &pass->resolve[location]);
    if (source->samples == 1 || target->samples != 1 || source->format != target->format ||
        extent.width != pass->extent.width || extent.height != pass->extent.height)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "pass '%s' cannot resolve '%s' (%s, %ux%u, %u samples) to '%s' (%s, "
                        "%ux%u, %u samples)",
                        pass->name, source->name, lobe_format_name(source->format),
                        pass->extent.width, pass->extent.height, source->samples, target->name,
                        lobe_format_name(target->format), extent.width, extent.height,
                        target->samples);
    return graph->frame.result == LOBE_OK;
}

static bool check_raster(lobe_pass *pass) {
    pass->samples = 0;
    for (uint32_t i = 0; i < ENGINE_MAXIMUM_COLOUR_ATTACHMENTS; i++)
        if (!check_attachment(pass, &pass->colour[i]))
            return false;
    if (!check_attachment(pass, &pass->depth))
        return false;
    for (uint32_t i = 0; i < ENGINE_MAXIMUM_COLOUR_ATTACHMENTS; i++)
        if (!check_resolve(pass, i))
            return false;
    if (pass->samples == 0)
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH, "raster pass '%s' has no attachments",
                        pass->name);
    return pass->graph->frame.result == LOBE_OK;
}

lobe_result engine_graph_check_rasters(lobe_graph *graph) {
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++)
        if (graph->frame.passes[i]->kind == LOBE_PASS_RASTER &&
            !check_raster(graph->frame.passes[i]))
            return graph->frame.result;
    return LOBE_OK;
}

engine_raster_parameters engine_graph_raster_parameters(const lobe_pass *pass,
                                                        const lobe_draw *draw) {
    const lobe_graph *graph = pass->graph;
    engine_raster_parameters parameters = {
        .vertex_shader = draw->vertex_shader,
        .fragment_shader = draw->fragment_shader,
        .specialisation = draw->specialisation,
        .specialisation_count = draw->specialisation_count,
        .cull = draw->cull,
        .depth_test = draw->depth_test,
        .depth_write = draw->depth_write,
        .depth_equal = draw->depth_equal,
        .blend = draw->blend,
        .samples = pass->samples,
    };
    for (uint32_t i = 0; i < ENGINE_MAXIMUM_COLOUR_ATTACHMENTS; i++)
        if (pass->colour[i].access != ENGINE_DEPENDENCY_NONE)
            parameters.colour[i] = attached(graph, &pass->colour[i])->format;
    if (pass->depth.access != ENGINE_DEPENDENCY_NONE)
        parameters.depth = attached(graph, &pass->depth)->format;
    return parameters;
}
