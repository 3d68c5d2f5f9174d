#include "passes/renderer/delivery.h"

#include <string.h>

#include "passes/context/pass_times.h"

frame_delivery passes_delivery_of(const lobe_render_parameters *parameters) {
    const lobe_render_target *target = parameters->host.target;
    return (frame_delivery){
        .target = target,
        .submission = parameters->host.submission,
        .reads_back = !parameters->discard && !parameters->host.submission,
        .aov = parameters->aov,
        .motion = parameters->motion.deliver || (target && target->motion),
    };
}

static lobe_result check_extent(const rendering *r, const shading_targets *imported) {
    const lobe_render_parameters *parameters = r->parameters;
    uint32_t width = parameters->width ? parameters->width : imported->width;
    uint32_t height = parameters->height ? parameters->height : imported->height;
    if (width == imported->width && height == imported->height)
        return LOBE_OK;
    return lobe_host_fail(r->context.host, LOBE_ERROR_INVALID_ARGUMENT,
                          "render: %ux%u pixels for a target of %ux%u", width, height,
                          imported->width, imported->height);
}

lobe_result passes_delivery_import(rendering *r, const frame_delivery *delivery,
                                   shading_targets *imported) {
    const lobe_render_target *target = delivery->target;
    lobe_graph *graph = r->renderer->graph;
    *imported = (shading_targets){0};
    if (!target)
        return LOBE_OK;
    if (!target->radiance)
        return lobe_host_fail(r->context.host, LOBE_ERROR_INVALID_ARGUMENT,
                              "render: a target without radiance");
    imported->radiance = lobe_graph_import_image(graph, target->radiance);
    if (target->depth)
        imported->depth = lobe_graph_import_image(graph, target->depth);
    if (target->motion)
        imported->motion = lobe_graph_import_image(graph, target->motion);
    imported->keep_radiance = target->keep;
    imported->keep_depth = target->keep && target->depth;
    imported->keep_motion = target->keep && target->motion;
    const lobe_image_description radiance = lobe_graph_describe_image(graph, imported->radiance);
    imported->width = radiance.width;
    imported->height = radiance.height;
    lobe_result result = imported->radiance.version ? check_extent(r, imported) : LOBE_OK;
    if (result == LOBE_OK && imported->width > 0) {
        r->width = r->context.view.width = imported->width;
        r->height = r->context.view.height = imported->height;
    }
    return result;
}

void passes_delivery_replace(const shading_targets *imported, shading_targets *targets) {
    if (imported->radiance.version)
        targets->radiance = imported->radiance;
    if (imported->depth.version)
        targets->depth = imported->depth;
    if (imported->motion.version)
        targets->motion = imported->motion;
    targets->keep_radiance = imported->keep_radiance;
    targets->keep_depth = imported->keep_depth;
    targets->keep_motion = imported->keep_motion;
}

void passes_delivery_mark_output(const rendering *r, const frame_delivery *delivery,
                                 lobe_resource resource) {
    if (delivery->reads_back)
        lobe_graph_read_back(r->renderer->graph, resource, (lobe_range){0});
    else
        lobe_graph_output(r->renderer->graph, resource);
}

lobe_result passes_delivery_run(rendering *r, const frame_delivery *delivery, lobe_frame *frame) {
    lobe_graph *graph = r->renderer->graph;
    const lobe_render_host *host = &r->parameters->host;
    if (delivery->prepares)
        return lobe_graph_prepare(graph, host->progress, host->user);
    lobe_result result = delivery->submission ? lobe_graph_submit(graph, delivery->submission)
                                              : lobe_graph_execute(graph);
    if (result != LOBE_OK)
        return result;
    r->renderer->fits_are_read_back = r->fits.reads_back;
    if (delivery->submission) {
        passes_pass_times_add_submission(frame, lobe_graph_describe(graph));
        return LOBE_OK;
    }
    passes_environment_light_save(&r->environment, graph, r->context.host);
    passes_fits_save(r);
    if (passes_pass_times_add(frame, lobe_graph_describe(graph), r->context.host->allocator))
        return LOBE_OK;
    return lobe_host_fail(r->context.host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          r->context.scene->scene->name);
}

lobe_result passes_delivery_take_image(const rendering *r, lobe_resource resource,
                                       lobe_format format, lobe_image *image) {
    size_t size = 0;
    const void *data = lobe_graph_data(r->renderer->graph, resource, &size);
    lobe_result result = lobe_image_allocate(image, format, r->width, r->height, r->context.host);
    if (result != LOBE_OK)
        return result;
    if (!data || size != (size_t)r->width * r->height * lobe_format_size(format))
        return lobe_host_fail(r->context.host, LOBE_ERROR_INVALID_ARGUMENT,
                              "render: an image to deliver is not of %ux%u texels of %s", r->width,
                              r->height, lobe_format_name(format));
    memcpy(image->texels, data, size);
    return LOBE_OK;
}
