#include "passes/renderer/renderer.h"

#include <string.h>

/// The first instance before `instance` whose maps it can share; `instance` if there is none.
static size_t instance_to_share_with(const filter_context *context, size_t instance) {
    const lobe_filter *filter = context->filter;
    if (filter->for_each_instance && filter->for_each_instance(context, instance))
        return instance;
    const device_instance *instances = context->scene->instances;
    for (size_t i = 0; i < instance; i++) {
        if (instances[i].material == instances[instance].material &&
            !(filter->for_each_instance && filter->for_each_instance(context, i)))
            return i;
    }
    return instance;
}

/// Without what the filter keeps for the material, nothing is built and the frame fails.
static void build_appearance(rendering *r, size_t instance, filtered_appearance *appearance) {
    const filter_context *context = &r->context;
    const uint32_t material = context->scene->instances[instance].material;
    const void *prepared;
    *appearance = (filtered_appearance){.graph = context->graph};
    if (!context->filter->build)
        return;
    lobe_result result =
        passes_filter_slots_prepare(&r->renderer->slots, context, material, &prepared);
    if (result == LOBE_OK)
        context->filter->build(context, instance, prepared, appearance);
    else
        lobe_graph_fail(context->graph, result, "filter '%s', material '%s': %s",
                        context->filter->name, context->scene->scene->materials[material].name,
                        lobe_result_message(result));
}

void passes_instance_maps_build(rendering *r, lobe_frame *frame) {
    const lobe_scene *scene = r->context.scene->scene;
    filtered_appearance *appearances = r->renderer->appearances;
    passes_given_images_take(r);
    memset(r->images.resources, 0,
           (scene->image_count + scene->material_count) * sizeof *r->images.resources);
    r->images.bytes = 0;
    frame->filtered_bytes = frame->base_texels = 0;
    for (size_t i = 0; i < scene->instance_count; i++) {
        size_t shared = instance_to_share_with(&r->context, i);
        if (shared < i) {
            appearances[i] = appearances[shared];
            continue;
        }
        build_appearance(r, i, &appearances[i]);
        frame->filtered_bytes += appearances[i].bytes;
        frame->base_texels += appearances[i].base_texels;
    }
    frame->filtered_bytes += r->images.bytes;
}

void passes_instance_maps_warn(const rendering *r) {
    const lobe_filter *filter = r->context.filter;
    const lobe_scene *scene = r->context.scene->scene;
    if (!filter->ignores || r->renderer->reported_filter == filter)
        return;
    for (size_t i = 0; i < scene->material_count; i++) {
        const char *limit = filter->ignores(&scene->materials[i]);
        if (limit)
            lobe_host_log(&r->renderer->host, LOBE_LOG_WARNING,
                          "%s: material '%s', filter '%s': %s", scene->name,
                          scene->materials[i].name, filter->name, limit);
    }
    r->renderer->reported_filter = filter;
}
