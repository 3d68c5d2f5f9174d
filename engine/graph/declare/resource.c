#include "engine/graph/declare/declare.h"

#include <string.h>

#include "engine/base/growing_array.h"
#include "engine/graph/store/store.h"

static uint32_t at_least_one(uint32_t value) {
    return value ? value : 1;
}

bool engine_graph_can_declare(lobe_graph *graph, const char *what) {
    if (!graph)
        return false;
    if (graph->frame.result != LOBE_OK)
        return false;
    if (graph->frame.phase == ENGINE_GRAPH_DECLARING)
        return true;
    lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                    "'%s' is declared after the frame was compiled; begin a new frame first", what);
    return false;
}

lobe_resource engine_graph_add_resource(lobe_graph *graph, const engine_graph_resource *resource,
                                        const engine_dependency_resource *dependency) {
    uint32_t index = graph->frame.dependencies.resource_count;
    if (!engine_array_reserve(graph->device->host.allocator, (void **)&graph->frame.resources,
                              &graph->frame.resource_capacity, (uint64_t)index + 1,
                              sizeof *graph->frame.resources)) {
        engine_graph_fail_memory(graph);
        return (lobe_resource){0};
    }
    graph->frame.resources[index] = *resource;
    if (engine_dependency_add_resource(&graph->frame.dependencies, dependency) ==
        ENGINE_DEPENDENCY_NONE) {
        engine_graph_fail_dependency(graph);
        return (lobe_resource){0};
    }
    return (lobe_resource){.index = index, .version = 1};
}

uint64_t engine_graph_range_bytes(const engine_graph_resource *resource, const lobe_range *range) {
    if (!resource->is_image)
        return resource->size;
    uint64_t texels = 0;
    for (uint32_t i = 0; i < range->level_count; i++)
        texels += (uint64_t)engine_graph_level_extent(resource->width, range->first_level + i) *
                  engine_graph_level_extent(resource->height, range->first_level + i);
    return texels * range->layer_count * lobe_format_size(resource->format) *
           (resource->samples > 1 ? resource->samples : 1);
}

static const char *copy_name(lobe_graph *graph, const char *name, const char *otherwise) {
    const char *kept = engine_arena_copy_text(&graph->frame.arena, name ? name : otherwise);
    if (!kept)
        engine_graph_fail_memory(graph);
    return kept;
}

// ---------------------------------------------------------------------------------------------
// Images and buffers of the graph

static bool check_extent(lobe_graph *graph, const lobe_image_description *image) {
    uint32_t limit = graph->device->limits.maxImageDimension2D;
    if (limit > LOBE_IMAGE_MAXIMUM_EXTENT)
        limit = LOBE_IMAGE_MAXIMUM_EXTENT;
    if (image->width == 0 || image->height == 0)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "image '%s': the extent is %ux%u texels",
                        image->name, image->width, image->height);
    else if (image->width > limit || image->height > limit)
        lobe_graph_fail(graph, LOBE_ERROR_LIMIT, "image '%s': %ux%u texels, the limit is %u",
                        image->name, image->width, image->height, limit);
    else if (image->layers > graph->device->limits.maxImageArrayLayers)
        lobe_graph_fail(graph, LOBE_ERROR_LIMIT, "image '%s': %u layers, the device's limit is %u",
                        image->name, image->layers, graph->device->limits.maxImageArrayLayers);
    return graph->frame.result == LOBE_OK;
}

static uint32_t possible_levels(uint32_t width, uint32_t height) {
    uint32_t levels = 1;
    for (uint32_t extent = width > height ? width : height; extent > 1; extent /= 2)
        levels++;
    return levels;
}

static bool check_shape(lobe_graph *graph, const lobe_image_description *image) {
    uint32_t levels = possible_levels(image->width, image->height);
    uint32_t samples = at_least_one(image->samples);
    if (image->format <= LOBE_FORMAT_NONE || image->format >= LOBE_FORMAT_COUNT)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "image '%s': has no format", image->name);
    else if (lobe_format_size(image->format) == 0)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "image '%s': only images of the host are compressed, as in %s", image->name,
                        lobe_format_name(image->format));
    else if (image->levels > levels)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "image '%s': %u levels, but %ux%u texels have at most %u", image->name,
                        image->levels, image->width, image->height, levels);
    else if (samples != 1 && samples != 2 && samples != 4)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "image '%s': %u samples, not 1, 2 or 4",
                        image->name, samples);
    else if (samples > 1 && (image->levels > 1 || image->layers > 1))
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "image '%s': a multisampled image must have one level and one layer",
                        image->name);
    return graph->frame.result == LOBE_OK;
}

static const engine_graph_resource *find_resource(const lobe_graph *graph, lobe_resource resource) {
    if (!graph || resource.version == 0 ||
        resource.index >= graph->frame.dependencies.resource_count)
        return NULL;
    return &graph->frame.resources[resource.index];
}

lobe_image_description lobe_graph_describe_image(const lobe_graph *graph, lobe_resource image) {
    const engine_graph_resource *resource = find_resource(graph, image);
    if (!resource || !resource->is_image)
        return (lobe_image_description){0};
    return (lobe_image_description){.format = resource->format,
                                    .width = resource->width,
                                    .height = resource->height,
                                    .layers = resource->layers,
                                    .levels = resource->levels,
                                    .samples = resource->samples};
}

size_t lobe_graph_buffer_size(const lobe_graph *graph, lobe_resource buffer) {
    const engine_graph_resource *resource = find_resource(graph, buffer);
    return resource && !resource->is_image ? resource->size : 0;
}

engine_access_state engine_graph_returned_state(uint64_t stages, uint64_t access) {
    const bool all = stages == 0;
    return (engine_access_state){
        .stages = all ? VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT : stages,
        .access = all ? VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT : access,
        .layout = ENGINE_LAYOUT_RETURNED};
}

engine_stamp engine_graph_lent_content(const lobe_graph *graph, uint64_t content,
                                       const uint64_t *numbers, size_t size) {
    return content ? engine_stamp_bytes(ENGINE_STAMP_NONE, numbers, size)
                   : engine_device_stamp(graph->device);
}

static engine_stamp identity_of(const engine_graph_resource *resource) {
    engine_stamp stamp = engine_stamp_mix(ENGINE_STAMP_NONE, resource->is_image);
    const uint64_t numbers[] = {resource->format, resource->width,  resource->height,
                                resource->layers, resource->levels, resource->samples,
                                resource->size};
    return engine_stamp_bytes(stamp, numbers, sizeof numbers);
}

/// Finds what earlier frames kept under this name; false if this frame has declared it already.
static bool claim_retained(lobe_graph *graph, engine_graph_resource *resource,
                           engine_dependency_resource *dependency) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++)
        if (graph->frame.resources[i].origin == ENGINE_GRAPH_RETAINED &&
            strcmp(graph->frame.resources[i].name, resource->name) == 0) {
            lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                            "retained resource '%s' is declared twice in one frame",
                            resource->name);
            return false;
        }
    for (engine_graph_retained *kept = graph->kept.retained; kept; kept = kept->next)
        if (strcmp(kept->name, resource->name) == 0 && kept->identity == dependency->identity) {
            kept->declared = true;
            kept->settles = resource->settles;
            kept->rest_offset = resource->rest_offset;
            engine_graph_hear_of_rest(graph, kept);
            resource->retained = kept;
            dependency->recorded = kept->stamps;
            dependency->start_layouts = kept->layouts;
            dependency->settled = kept->settled;
        }
    return true;
}

/// Between frames, where other graphs may use it.
static const engine_access_state at_rest = {.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                            .access = VK_ACCESS_2_MEMORY_READ_BIT,
                                            .layout = ENGINE_LAYOUT_SAMPLED};

static lobe_resource declare(lobe_graph *graph, engine_graph_resource *resource, bool retained) {
    engine_dependency_resource dependency = {.name = resource->name,
                                             .levels = resource->levels,
                                             .layers = resource->layers,
                                             .retained = retained,
                                             .evolves = resource->evolves,
                                             .settles = resource->settles,
                                             .rests = resource->shared,
                                             .after = at_rest,
                                             .identity = identity_of(resource)};
    if (retained) {
        resource->origin = ENGINE_GRAPH_RETAINED;
        if (!claim_retained(graph, resource, &dependency))
            return (lobe_resource){0};
    }
    return engine_graph_add_resource(graph, resource, &dependency);
}

lobe_resource lobe_graph_image(lobe_graph *graph, const lobe_image_description *description) {
    if (!description) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "lobe_graph_image: description must not be NULL");
        return (lobe_resource){0};
    }
    lobe_image_description image = *description;
    if (!engine_graph_can_declare(graph, image.name ? image.name : "image"))
        return (lobe_resource){0};
    image.name = copy_name(graph, image.name, "image");
    if (!image.name || !check_extent(graph, &image) || !check_shape(graph, &image))
        return (lobe_resource){0};
    engine_graph_resource resource = {.name = image.name,
                                      .is_image = true,
                                      .format = image.format,
                                      .width = image.width,
                                      .height = image.height,
                                      .layers = at_least_one(image.layers),
                                      .levels = at_least_one(image.levels),
                                      .samples = at_least_one(image.samples),
                                      .shared = image.retained && image.shared &&
                                                !graph->kept.uploads.apart,
                                      .permanent = image.retained && image.permanent};
    return declare(graph, &resource, image.retained);
}

lobe_resource lobe_graph_buffer(lobe_graph *graph, const lobe_buffer_description *description) {
    if (!description) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "lobe_graph_buffer: description must not be NULL");
        return (lobe_resource){0};
    }
    const char *given = description->name ? description->name : "buffer";
    if (!engine_graph_can_declare(graph, given))
        return (lobe_resource){0};
    const char *name = copy_name(graph, given, given);
    uint64_t limit = graph->device->limits.maxStorageBufferRange;
    if (name && description->size == 0)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "buffer '%s': the size is 0", name);
    else if (name && description->rest_offset > 0 &&
             (description->size < 4 || description->rest_offset > description->size - 4))
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "buffer '%s': rest_offset is %zu, but there are %zu bytes", name,
                        description->rest_offset, description->size);
    else if (name && description->size > limit)
        lobe_graph_fail(graph, LOBE_ERROR_LIMIT,
                        "buffer '%s': %zu bytes, the device's limit is %llu", name,
                        description->size, (unsigned long long)limit);
    if (graph->frame.result != LOBE_OK)
        return (lobe_resource){0};
    engine_graph_resource resource = {.name = name,
                                      .layers = 1,
                                      .levels = 1,
                                      .size = description->size,
                                      .evolves = description->retained && description->evolves};
    if (resource.evolves) {
        resource.settles = description->settles;
        resource.rest_offset = description->rest_offset;
    }
    return declare(graph, &resource, description->retained);
}

bool lobe_graph_has_content(const lobe_graph *graph, lobe_resource resource) {
    const engine_graph_resource *found = find_resource(graph, resource);
    const engine_graph_retained *kept = found ? found->retained : NULL;
    for (uint32_t i = 0; kept && i < kept->subresource_count; i++)
        if (kept->stamps[i] == ENGINE_STAMP_NONE)
            return false;
    return kept != NULL;
}

// ---------------------------------------------------------------------------------------------
// What comes from the host

/// What a texture or buffer was imported as; textures or buffers of equal content may share one
/// Vulkan object, of which a frame keeps one layout.
static uint32_t find_texture(const lobe_graph *graph, const lobe_texture *texture) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++)
        if (graph->frame.resources[i].origin == ENGINE_GRAPH_TEXTURE &&
            graph->frame.resources[i].texture->image == texture->image)
            return i;
    return ENGINE_DEPENDENCY_NONE;
}

static uint32_t find_buffer(const lobe_graph *graph, const lobe_buffer *buffer) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++)
        if (graph->frame.resources[i].origin == ENGINE_GRAPH_BUFFER &&
            graph->frame.resources[i].buffer->buffer == buffer->buffer)
            return i;
    return ENGINE_DEPENDENCY_NONE;
}

/// What belongs to another graph may not have its content yet when this frame runs, or be gone.
static bool may_use(lobe_graph *graph, const engine_upload_state *uploads, const char *name) {
    if (!uploads->queue || uploads->queue == &graph->kept.uploads)
        return true;
    lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "render graph: '%s' belongs to another graph", name);
    return false;
}

lobe_resource lobe_graph_import_texture(lobe_graph *graph, const lobe_texture *texture) {
    if (!texture) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "lobe_graph_import_texture: texture must not be NULL");
        return (lobe_resource){0};
    }
    static const engine_layout layout = ENGINE_LAYOUT_SAMPLED;
    if (!engine_graph_can_declare(graph, texture->name) ||
        !may_use(graph, &texture->uploads, texture->name))
        return (lobe_resource){0};
    uint32_t known = find_texture(graph, texture);
    if (known != ENGINE_DEPENDENCY_NONE)
        return (lobe_resource){.index = known, .version = 1};
    engine_graph_resource resource = {.name = copy_name(graph, texture->name, "texture"),
                                      .origin = ENGINE_GRAPH_TEXTURE,
                                      .is_image = true,
                                      .format = texture->format,
                                      .width = texture->width,
                                      .height = texture->height,
                                      .layers = 1,
                                      .levels = 1,
                                      .samples = 1,
                                      .texture = texture,
                                      .bytes = texture->allocation.size};
    engine_dependency_resource dependency = {.name = resource.name,
                                             .levels = 1,
                                             .layers = 1,
                                             .imported = true,
                                             .identity = texture->stamp,
                                             .start_layouts = &layout};
    return resource.name ? engine_graph_add_resource(graph, &resource, &dependency)
                         : (lobe_resource){0};
}

lobe_resource lobe_graph_import_buffer(lobe_graph *graph, const lobe_buffer *buffer) {
    if (!buffer) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "lobe_graph_import_buffer: buffer must not be NULL");
        return (lobe_resource){0};
    }
    if (!engine_graph_can_declare(graph, buffer->name) ||
        !may_use(graph, &buffer->uploads, buffer->name))
        return (lobe_resource){0};
    uint32_t known = find_buffer(graph, buffer);
    if (known != ENGINE_DEPENDENCY_NONE)
        return (lobe_resource){.index = known, .version = 1};
    engine_graph_resource resource = {.name = copy_name(graph, buffer->name, "buffer"),
                                      .origin = ENGINE_GRAPH_BUFFER,
                                      .layers = 1,
                                      .levels = 1,
                                      .size = buffer->size,
                                      .buffer = buffer,
                                      .bytes = buffer->allocation.size};
    engine_dependency_resource dependency = {.name = resource.name,
                                             .levels = 1,
                                             .layers = 1,
                                             .imported = true,
                                             .identity = buffer->stamp};
    return resource.name ? engine_graph_add_resource(graph, &resource, &dependency)
                         : (lobe_resource){0};
}

lobe_resource lobe_graph_upload(lobe_graph *graph, const char *name, const void *data,
                                size_t size) {
    if (!data) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "lobe_graph_upload: data must not be NULL");
        return (lobe_resource){0};
    }
    const char *given = name ? name : "upload";
    if (!engine_graph_can_declare(graph, given))
        return (lobe_resource){0};
    if (size == 0 || size > ENGINE_MAXIMUM_UPLOAD) {
        lobe_graph_fail(graph, size ? LOBE_ERROR_LIMIT : LOBE_ERROR_GRAPH,
                        "upload '%s': %zu bytes is not in [1, %zu]", given, size,
                        ENGINE_MAXIMUM_UPLOAD);
        return (lobe_resource){0};
    }
    engine_graph_resource resource = {.name = copy_name(graph, given, given),
                                      .origin = ENGINE_GRAPH_UPLOAD,
                                      .layers = 1,
                                      .levels = 1,
                                      .size = size,
                                      .upload = engine_arena_copy(&graph->frame.arena, data, size),
                                      .bytes = size};
    if (!resource.name || !resource.upload) {
        engine_graph_fail_memory(graph);
        return (lobe_resource){0};
    }
    engine_dependency_resource dependency = {.name = resource.name,
                                             .levels = 1,
                                             .layers = 1,
                                             .imported = true,
                                             .identity =
                                                 engine_stamp_bytes(ENGINE_STAMP_NONE, data, size)};
    return engine_graph_add_resource(graph, &resource, &dependency);
}
