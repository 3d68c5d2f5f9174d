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

// ---------------------------------------------------------------------------------------------
// The target

static bool has_viewport(const lobe_render_target *target) {
    const lobe_rectangle *given = &target->viewport;
    return given->x || given->y || given->width || given->height;
}

static lobe_result check_extent(const rendering *r, const char *what,
                                const lobe_rectangle *viewport) {
    const lobe_render_parameters *parameters = r->parameters;
    const uint32_t width = parameters->width ? parameters->width : viewport->width;
    const uint32_t height = parameters->height ? parameters->height : viewport->height;
    if (width == viewport->width && height == viewport->height)
        return LOBE_OK;
    return lobe_host_fail(r->context.host, LOBE_ERROR_INVALID_ARGUMENT,
                          "render: %ux%u pixels for a %s of %ux%u", width, height, what,
                          viewport->width, viewport->height);
}

/// `*fills`: it is all of the images.
static lobe_result check_viewport(const rendering *r, const shading_targets *images,
                                  const lobe_rectangle *viewport, bool *fills) {
    const lobe_resource imported[] = {images->radiance, images->depth, images->motion};
    *fills = true;
    for (int i = 0; i < 3; i++) {
        if (!imported[i].version)
            continue;
        const lobe_image_description image =
            lobe_graph_describe_image(r->renderer->graph, imported[i]);
        if (!lobe_rectangle_lies_within(viewport, image.width, image.height))
            return lobe_host_fail(r->context.host, LOBE_ERROR_INVALID_ARGUMENT,
                                  "render: a viewport of %ux%u pixels at (%u, %u) does not lie "
                                  "within a target of %ux%u",
                                  viewport->width, viewport->height, viewport->x, viewport->y,
                                  image.width, image.height);
        *fills = *fills && image.width == viewport->width && image.height == viewport->height;
    }
    return check_extent(r, "viewport", viewport);
}

/// An image for the pixels of the viewport, with those of `whole` if they are kept.
static lobe_resource declare_part(lobe_graph *graph, const char *name, lobe_resource whole,
                                  const lobe_rectangle *viewport, bool keep) {
    if (!whole.version)
        return whole;
    lobe_resource part = lobe_graph_image(
        graph, &(lobe_image_description){.name = name,
                                         .format = lobe_graph_describe_image(graph, whole).format,
                                         .width = viewport->width,
                                         .height = viewport->height});
    if (!keep)
        return part;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "viewport_content");
    return lobe_pass_copy_part(pass, whole, viewport, part, 0, 0);
}

/// Rasterisation rounds by where a pixel is in the image, so that only a picture drawn on its own
/// is the same everywhere.
static void draw_apart(lobe_graph *graph, const lobe_rectangle *viewport,
                       delivery_target *imported) {
    shading_targets *drawn = &imported->drawn;
    imported->radiance = drawn->radiance;
    imported->depth = drawn->depth;
    imported->motion = drawn->motion;
    drawn->radiance = declare_part(graph, "viewport's radiance", imported->radiance, viewport,
                                   drawn->keep_radiance);
    drawn->depth =
        declare_part(graph, "viewport's depth", imported->depth, viewport, drawn->keep_depth);
    drawn->motion =
        declare_part(graph, "viewport's motion", imported->motion, viewport, drawn->keep_motion);
}

lobe_result passes_delivery_import(rendering *r, const frame_delivery *delivery,
                                   delivery_target *imported) {
    const lobe_render_target *target = delivery->target;
    lobe_graph *graph = r->renderer->graph;
    *imported = (delivery_target){0};
    if (!target)
        return LOBE_OK;
    if (!target->radiance)
        return lobe_host_fail(r->context.host, LOBE_ERROR_INVALID_ARGUMENT,
                              "render: a target without radiance");
    shading_targets *drawn = &imported->drawn;
    drawn->radiance = lobe_graph_import_image(graph, target->radiance);
    if (target->depth)
        drawn->depth = lobe_graph_import_image(graph, target->depth);
    if (target->motion)
        drawn->motion = lobe_graph_import_image(graph, target->motion);
    drawn->keep_radiance = target->keep;
    drawn->keep_depth = target->keep && target->depth;
    drawn->keep_motion = target->keep && target->motion;
    if (!drawn->radiance.version)
        return LOBE_OK;
    const lobe_image_description image = lobe_graph_describe_image(graph, drawn->radiance);
    const lobe_rectangle all = {0, 0, image.width, image.height};
    const lobe_rectangle viewport = has_viewport(target) ? target->viewport : all;
    bool fills = true;
    const lobe_result result = has_viewport(target) ? check_viewport(r, drawn, &viewport, &fills)
                                                    : check_extent(r, "target", &all);
    if (result != LOBE_OK)
        return result;
    drawn->width = r->width = r->context.view.width = viewport.width;
    drawn->height = r->height = r->context.view.height = viewport.height;
    if (!fills)
        draw_apart(graph, &viewport, imported);
    return LOBE_OK;
}

void passes_delivery_replace(const delivery_target *imported, shading_targets *targets) {
    const shading_targets *drawn = &imported->drawn;
    if (drawn->radiance.version)
        targets->radiance = drawn->radiance;
    if (drawn->depth.version)
        targets->depth = drawn->depth;
    if (drawn->motion.version)
        targets->motion = drawn->motion;
    targets->keep_radiance = drawn->keep_radiance;
    targets->keep_depth = drawn->keep_depth;
    targets->keep_motion = drawn->keep_motion;
}

static void place(lobe_pass *pass, const lobe_rectangle *viewport, lobe_resource whole,
                  lobe_resource *drawn) {
    const lobe_rectangle all = {0, 0, viewport->width, viewport->height};
    if (whole.version)
        *drawn = lobe_pass_copy_part(pass, *drawn, &all, whole, viewport->x, viewport->y);
}

void passes_delivery_place(const rendering *r, const frame_delivery *delivery,
                           const delivery_target *imported, shading_targets *targets) {
    if (!imported->radiance.version)
        return;
    const lobe_rectangle *viewport = &delivery->target->viewport;
    lobe_pass *pass = lobe_graph_add_pass(r->renderer->graph, LOBE_PASS_TRANSFER, "viewport");
    place(pass, viewport, imported->radiance, &targets->radiance);
    place(pass, viewport, imported->depth, &targets->depth);
    place(pass, viewport, imported->motion, &targets->motion);
}

// ---------------------------------------------------------------------------------------------
// The frame

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
