#include "passes/renderer/surfaces/surfaces.h"

#include <string.h>

#include "passes/context/fit_work.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/renderer/shadows/shadow_maps.h"
#include "passes/renderer/surfaces/deferral.h"
#include "passes/renderer/surfaces/masks.h"
#include "shaders/interface/picture/surfaces.h"
#include "shaders/interface/specialisation.h"

/// What the passes share.
typedef struct surfaces_drawing {
    const filter_context *context;
    const draw_list *draws;
    lobe_resource frame;
    const shading_selection *selection; ///< NULL: all pixels
    bool plane, colours;                ///< the picture has these layers
} surfaces_drawing;

seen_surfaces passes_surfaces_absent(const filter_context *context) {
    return (seen_surfaces){.layers =
                               lobe_graph_import_texture(context->graph, context->scene->white)};
}

bool passes_surfaces_show(const filter_context *context, const seen_surfaces *surfaces,
                          const instance_batch *batch, bool deferred) {
    return !surfaces->present || (surfaces->open && !deferred) ||
           passes_surfaces_hold(context, batch) == deferred;
}

void passes_surfaces_set_draw(lobe_draw *draw) {
    draw->vertex_shader = "shading/surfaces/surfaces.vert";
    draw->cull = LOBE_CULL_NONE;
    draw->depth_test = draw->depth_equal = true;
    draw->depth_write = false;
    draw->index_count = 3;
}

lobe_binding passes_surfaces_binding(const seen_surfaces *surfaces) {
    return (lobe_binding){.name = "rectangle_block", .resource = surfaces->rectangles};
}

// ---------------------------------------------------------------------------------------------
// Which layers

static bool has_colour(const filter_context *context, const instance_batch *batch) {
    const device_scene *scene = context->scene;
    return scene->scene->meshes[scene->instances[batch->instance].mesh].has_colour;
}

/// Whether shading needs to know how the triangle lies that is seen.
static bool needs_plane(const filter_context *context, const instance_batch *batch) {
    return batch->displaced.vertices.version > 0 || passes_batch_map_width(context, batch) > 0;
}

static void find_layers(surfaces_drawing *d) {
    d->plane = passes_shadow_maps_wanted(d->context);
    for (uint32_t i = 0; i < d->draws->batch_count; i++) {
        const instance_batch *batch = &d->draws->batches[i];
        if (!passes_surfaces_hold(d->context, batch))
            continue;
        d->plane |= needs_plane(d->context, batch);
        d->colours |= has_colour(d->context, batch);
    }
}

static uint32_t layer_count(const surfaces_drawing *d) {
    if (d->colours)
        return SURFACES_LAYERS;
    return d->plane ? SURFACES_PLANE_LAYERS : SURFACES_LEAST_LAYERS;
}

// ---------------------------------------------------------------------------------------------
// Passes

/// Where nothing is drawn: shaders of pixels around may take steps with it, and drop the result.
static const float nothing[SURFACES_LAYERS][4] = {
    [SURFACES_NORMAL] = {0, 0, 1, 0},
    [SURFACES_TANGENT] = {1, 0, 0, 0},
    [SURFACES_GRADIENTS] = {1e-3f, 0, 0, 1e-3f},
    [SURFACES_RIGHT] = {1e-3f, 0, 0, 0},
    [SURFACES_DOWN] = {0, 1e-3f, 0, 0},
    [SURFACES_COLOUR] = {1, 1, 1, 1},
};

static lobe_resource attach(const surfaces_drawing *d, lobe_pass *pass,
                            const shading_targets *targets) {
    lobe_resource layers =
        lobe_graph_image(d->context->graph, &(lobe_image_description){
                                                .name = "surfaces",
                                                .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                .width = targets->width,
                                                .height = targets->height,
                                                .layers = layer_count(d),
                                            });
    for (uint32_t i = 0; i < layer_count(d); i++) {
        lobe_attachment attachment = {.resource = layers, .layer = i};
        memcpy(attachment.clear, nothing[i], sizeof attachment.clear);
        layers = lobe_pass_colour(pass, i, &attachment);
    }
    return layers;
}

static bool is_masked(const surfaces_drawing *d, const instance_batch *batch) {
    const device_scene *scene = d->context->scene;
    return scene->materials[scene->instances[batch->instance].material].masked;
}

static void specialise_draw(const surfaces_drawing *d, const instance_batch *batch,
                            specialisation_list *list) {
    passes_specialise(list, SPECIALISE_MIRRORED, batch->mirrored);
    passes_specialise(list, SPECIALISE_DISPLACED, batch->displaced.vertices.version > 0);
    passes_specialise(list, SPECIALISE_STRETCHED, passes_batch_map_width(d->context, batch) > 0);
    passes_knobs_specialise(d->context, list);
    if (is_masked(d, batch))
        passes_surface_mask_specialise(d->context, batch, list);
}

static size_t bind_draw(const surfaces_drawing *d, const instance_batch *batch,
                        lobe_binding *bindings) {
    bindings[0] = (lobe_binding){.name = "instance_block",
                                 .resource = passes_batch_transforms(batch, DRAW_FOR_PICTURE)};
    bindings[1] = (lobe_binding){.name = "vertex_block",
                                 .resource = passes_batch_vertices(d->context, batch)};
    if (!is_masked(d, batch))
        return 2;
    passes_surface_mask_bind(d->context, batch, bindings + 2);
    return 2 + SURFACE_MASK_BINDINGS;
}

static void draw_batch(const surfaces_drawing *d, lobe_pass *pass, uint32_t index) {
    const filter_context *context = d->context;
    const instance_batch *batch = &d->draws->batches[index];
    const struct draw_constants constants = {
        .first_instance = batch->first,
        .map_width = passes_batch_map_width(context, batch),
        .number = 1 + index,
    };
    lobe_binding bindings[2 + SURFACE_MASK_BINDINGS];
    const size_t binding_count = bind_draw(d, batch, bindings);
    specialisation_list list = {.graph = context->graph};
    specialise_draw(d, batch, &list);
    lobe_draw draw = {
        .vertex_shader = "shading/shading.vert",
        .fragment_shader = is_masked(d, batch) ? "shading/surfaces/surfaces_mask.frag"
                                               : "shading/surfaces/surfaces.frag",
        .cull = passes_batch_cull(context->scene, batch),
        .depth_test = true,
        .depth_write = true,
        .constants = &constants,
        .constants_size = sizeof constants,
        .specialisation = list.items,
        .specialisation_count = list.count,
        .bindings = bindings,
        .binding_count = binding_count,
    };
    passes_batch_set_counts(context, batch, DRAW_FOR_PICTURE, &draw);
    passes_selection_count(d->selection, FIRST_INSTANCE_DRAW + index, &draw);
    lobe_pass_draw(pass, &draw);
}

static lobe_resource draw_layers(const surfaces_drawing *d, shading_targets *targets) {
    lobe_pass *pass = lobe_graph_add_pass(d->context->graph, LOBE_PASS_RASTER, "surfaces");
    lobe_pass_read(pass, &(lobe_binding){.name = "frame_block", .resource = d->frame});
    passes_shared_knobs_bind(d->context, pass);
    const lobe_resource layers = attach(d, pass, targets);
    targets->depth = lobe_pass_depth(
        pass, &(lobe_attachment){.resource = targets->depth,
                                 .load = targets->keep_depth ? LOBE_LOAD_KEEP : LOBE_LOAD_CLEAR});
    if (d->selection)
        passes_selection_mask(pass, d->selection, "shading/surfaces/surface_mask.frag");
    for (uint32_t i = 0; i < d->draws->batch_count; i++)
        if (passes_surfaces_hold(d->context, &d->draws->batches[i]))
            draw_batch(d, pass, i);
    return layers;
}

static lobe_resource draw_numbers(const filter_context *context, lobe_resource layers,
                                  const shading_targets *targets) {
    const lobe_resource numbers =
        lobe_graph_image(context->graph, &(lobe_image_description){.name = "numbers of surfaces",
                                                                   .format = LOBE_FORMAT_D32_FLOAT,
                                                                   .width = targets->width,
                                                                   .height = targets->height});
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_RASTER, "surface_numbers");
    const lobe_binding binding = {.name = "surfaces", .resource = layers};
    const lobe_resource drawn =
        lobe_pass_depth(pass, &(lobe_attachment){.resource = numbers, .load = LOBE_LOAD_DISCARD});
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "shading/background.vert",
                                      .fragment_shader = "shading/surfaces/surface_numbers.frag",
                                      .index_count = 3,
                                      .depth_write = true,
                                      .bindings = &binding,
                                      .binding_count = 1});
    return drawn;
}

// ---------------------------------------------------------------------------------------------
// Rectangles of the batches. The first is nobody's.

/// Passing over the whole picture for each of fewer batches takes less time than to find where
/// they are.
#define FEW_BATCHES 16u

/// Pipelines are made for scenes with more of them, too.
static bool has_few_batches(const surfaces_drawing *d) {
    const bool prepares = d->context->work && d->context->work->is_dry;
    return d->draws->batch_count <= FEW_BATCHES && !prepares;
}

static lobe_resource whole_picture(const surfaces_drawing *d, const shading_targets *targets) {
    struct surface_rectangle rectangles[1 + FEW_BATCHES];
    for (uint32_t i = 0; i <= FEW_BATCHES; i++)
        rectangles[i] = (struct surface_rectangle){.right = targets->width,
                                                   .bottom = targets->height,
                                                   .from_right = targets->width,
                                                   .from_bottom = targets->height};
    return lobe_graph_upload(d->context->graph, "rectangles of surfaces", rectangles,
                             sizeof rectangles);
}

static lobe_resource find_rectangles(const surfaces_drawing *d, lobe_resource layers,
                                     const shading_targets *targets) {
    lobe_graph *graph = d->context->graph;
    const lobe_buffer_description description = {
        .name = "rectangles of surfaces",
        .size = (1 + d->draws->batch_count) * sizeof(struct surface_rectangle),
    };
    lobe_pass *clear = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "clear");
    const lobe_resource none = lobe_pass_fill(clear, lobe_graph_buffer(graph, &description),
                                              (lobe_range){0}, (float[4]){0});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "surface_rectangles");
    lobe_pass_read(pass, &(lobe_binding){.name = "surfaces", .resource = layers});
    const lobe_resource found =
        lobe_pass_modify(pass, &(lobe_binding){.name = "rectangle_block", .resource = none});
    const uint32_t runs = (targets->width + SURFACE_RUN - 1) / SURFACE_RUN;
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "shading/surfaces/surface_rectangles.comp",
                                              .threads = {runs, targets->height, 1}});
    return found;
}

// ---------------------------------------------------------------------------------------------

seen_surfaces passes_surfaces(const filter_context *context, const draw_list *draws,
                              lobe_resource frame, const shading_selection *selection,
                              shading_targets *targets) {
    if (!passes_defers_shading(context, draws))
        return passes_surfaces_absent(context);
    surfaces_drawing d = {
        .context = context, .draws = draws, .frame = frame, .selection = selection};
    find_layers(&d);
    const bool open = passes_shading_is_open(context);
    seen_surfaces surfaces = {.present = true, .holds_all = !open, .open = open};
    for (uint32_t i = 0; i < draws->batch_count; i++)
        surfaces.holds_all &= passes_surfaces_hold(context, &draws->batches[i]);
    surfaces.layers = draw_layers(&d, targets);
    surfaces.numbers = draw_numbers(context, surfaces.layers, targets);
    surfaces.rectangles = has_few_batches(&d) ? whole_picture(&d, targets)
                                              : find_rectangles(&d, surfaces.layers, targets);
    return surfaces;
}
