#include "passes/renderer/samples/sample_choice.h"

#include "passes/context/camera.h"
#include "passes/context/sample_count.h"
#include "passes/displacement/drawn_bounds.h"
#include "passes/renderer/samples/picture_key.h"
#include "passes/renderer/shading.h"
#include "shaders/interface/picture/sample_choice.h"

static lobe_resource declare_buffer(const filter_context *context, const char *name, size_t size) {
    return lobe_graph_buffer(context->graph,
                             &(lobe_buffer_description){.name = name, .size = size});
}

/// An empty list, with room for every pixel.
static lobe_resource declare_list(const filter_context *context) {
    const size_t pixels = (size_t)context->view.width * context->view.height;
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_TRANSFER, "clear");
    lobe_resource list =
        declare_buffer(context, "sample list", (SAMPLE_LIST_FIRST + pixels) * sizeof(uint32_t));
    return lobe_pass_fill(pass, list, (lobe_range){0}, (float[4]){0});
}

static struct sample_choice_constants constants_of(const filter_context *context, bool blended) {
    const filter_view *view = &context->view;
    float minimum[3], maximum[3];
    const sample_count count = passes_sample_count(context);
    struct sample_choice_constants constants = {
        .most = count.most,
        .everywhere = count.everywhere,
        .tiles = passes_picture_key_tiles(view->width, view->height),
        .blended = blended,
    };
    passes_drawn_bounds(context->scene, minimum, maximum);
    passes_camera_slope_scale(view->camera, view->height, minimum, maximum, &constants.depth_scale,
                              &constants.depth_offset);
    return constants;
}

static void choose(const filter_context *context, lobe_resource radiance, bool blended,
                   sample_choice *choice) {
    lobe_graph *graph = context->graph;
    const filter_view *view = &context->view;
    const struct sample_choice_constants constants = constants_of(context, blended);
    const lobe_resource sums = passes_picture_key(graph, radiance, view->width, view->height);
    choice->counts = lobe_graph_image(graph, &(lobe_image_description){
                                                 .name = "sample counts",
                                                 .format = LOBE_FORMAT_R32_FLOAT,
                                                 .width = view->width,
                                                 .height = view->height,
                                             });
    choice->list = declare_list(context);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "sample_choice");
    lobe_pass_read(pass, &(lobe_binding){.name = "radiance", .resource = radiance});
    lobe_pass_read(pass, &(lobe_binding){.name = "sum_block", .resource = sums});
    choice->counts =
        lobe_pass_write(pass, &(lobe_binding){.name = "counts", .resource = choice->counts});
    choice->list =
        lobe_pass_modify(pass, &(lobe_binding){.name = "list_block", .resource = choice->list});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "shading/samples/sample_choice.comp",
                                              .threads = {view->width, view->height, 1},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
}

/// The counts of each draw of a shading pass; all zero if out of memory.
static lobe_resource upload_counts(const filter_context *context, const draw_list *draws) {
    const size_t count = passes_shading_draw_count(draws);
    shading_draw_count *counts =
        lobe_allocate(lobe_host_allocator(context->host), count, sizeof *counts);
    if (!counts) {
        lobe_graph_fail(context->graph, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory for draws",
                        context->scene->scene->name);
        return (lobe_resource){0};
    }
    for (size_t i = 0; i < count; i++)
        counts[i] = passes_shading_draw_counts(context, draws, i);
    lobe_resource resource =
        lobe_graph_upload(context->graph, "draw counts", counts, count * sizeof *counts);
    lobe_release(counts);
    return resource;
}

/// The arguments of batches of which the device knows how many instances are seen; `none` if there
/// are no such batches.
static lobe_resource seen_arguments(const draw_list *list, lobe_resource none) {
    for (uint32_t i = 0; i < list->batch_count; i++)
        if (list->batches[i].seen[DRAW_FOR_PICTURE].transforms.version > 0)
            return list->batches[i].seen[DRAW_FOR_PICTURE].arguments;
    return none;
}

static void write_arguments(const filter_context *context, const draw_list *list,
                            sample_choice *choice) {
    const uint32_t draws = (uint32_t)passes_shading_draw_count(list);
    const lobe_resource counts = upload_counts(context, list);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "sample_arguments");
    choice->arguments =
        declare_buffer(context, "sample arguments", (1 + draws) * sizeof(lobe_draw_arguments));
    lobe_pass_read(pass, &(lobe_binding){.name = "list_block", .resource = choice->list});
    lobe_pass_read(pass, &(lobe_binding){.name = "count_block", .resource = counts});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "seen_block", .resource = seen_arguments(list, counts)});
    choice->arguments = lobe_pass_write(
        pass, &(lobe_binding){.name = "argument_block", .resource = choice->arguments});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "shading/samples/sample_arguments.comp",
                                              .threads = {1 + draws, 1, 1},
                                              .constants = &draws,
                                              .constants_size = sizeof draws});
}

static bool is_displaced(const draw_list *list, size_t draw) {
    const instance_batch *batch = passes_shading_draw_batch(list, draw);
    return batch && batch->displaced.vertices.version > 0;
}

/// Only the device knows how many indices displaced geometry has.
static void write_displaced_counts(const filter_context *context, const draw_list *list,
                                   sample_choice *choice) {
    const size_t draws = passes_shading_draw_count(list);
    lobe_pass *pass = NULL;
    for (size_t i = 0; i < draws; i++) {
        if (!is_displaced(list, i))
            continue;
        if (!pass)
            pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "displaced_counts");
        const uint32_t record = 1 + (uint32_t)i;
        const lobe_binding counted = {.name = "displaced_argument_block",
                                      .resource =
                                          passes_shading_draw_batch(list, i)->displaced.arguments};
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "shading/samples/displaced_count.comp",
                                                  .constants = &record,
                                                  .constants_size = sizeof record,
                                                  .bindings = &counted,
                                                  .binding_count = 1});
    }
    if (pass)
        choice->arguments = lobe_pass_modify(
            pass, &(lobe_binding){.name = "argument_block", .resource = choice->arguments});
}

sample_choice passes_sample_choice(const filter_context *context, const draw_list *draws,
                                   lobe_resource radiance, bool blended) {
    sample_choice choice;
    choose(context, radiance, blended, &choice);
    write_arguments(context, draws, &choice);
    write_displaced_counts(context, draws, &choice);
    return choice;
}
