#include "passes/renderer/shadows/shadow_maps.h"

#include <math.h>
#include <string.h>

#include "passes/context/camera.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/displacement/drawn_bounds.h"
#include "passes/filters/material_shading.h"
#include "passes/renderer/culling/culling.h"
#include "passes/renderer/shadows/shadow_views.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/instance.h"
#include "shaders/interface/shadow.h"
#include "shaders/interface/specialisation.h"

/// Texels of all layers: 512 MiB.
#define MOST_TEXELS (1u << 26)
/// What every Vulkan device has.
#define MOST_LAYERS 256u

// ---------------------------------------------------------------------------------------------
// Which lights

shadow_plan passes_shadow_plan(const filter_context *context) {
    const uint32_t choice = passes_knob_choice(context, &passes_knob_shadows);
    shadow_plan plan = {0};
    if (choice == 0)
        return plan;
    plan.extent = 256u << choice;
    plan.room = MOST_TEXELS / (plan.extent * plan.extent);
    if (plan.room > MOST_LAYERS)
        plan.room = MOST_LAYERS;
    return plan;
}

uint32_t passes_shadow_plan_take(shadow_plan *plan, const lobe_light *light) {
    const uint32_t count = passes_shadow_view_count(light);
    if (plan->extent == 0)
        return 0;
    if (plan->layers + count > plan->room) {
        plan->missed++;
        return 0;
    }
    plan->layers += count;
    return count;
}

// ---------------------------------------------------------------------------------------------
// Draws

static void draw_batch(const filter_context *context, lobe_pass *pass,
                       const instance_batch *batch) {
    const device_scene *scene = context->scene;
    const device_material *material = &scene->materials[scene->instances[batch->instance].material];
    const bool masked = material->masked;
    const struct draw_constants constants = {.first_instance = batch->first};
    lobe_binding bindings[3 + MAP_SHADING] = {
        {.name = "instance_block", .resource = passes_batch_transforms(batch, DRAW_FOR_LIGHT)},
        {.name = "vertex_block", .resource = passes_batch_vertices(context, batch)},
    };
    size_t binding_count = 2;
    specialisation_list list = {.graph = context->graph};
    if (masked) {
        bindings[2] = (lobe_binding){
            .name = "material_block",
            .resource = lobe_graph_import_buffer(context->graph, material->constants)};
        passes_material_maps_bind(context, material, bindings + 3);
        binding_count = sizeof bindings / sizeof *bindings;
        passes_material_specialise(material, &list);
        passes_specialise(&list, SPECIALISE_VERTEX_COLOUR,
                          scene->scene->meshes[scene->instances[batch->instance].mesh].has_colour);
    }
    lobe_draw draw = {
        .vertex_shader = "shading/shadows/shadow_map.vert",
        .fragment_shader =
            masked ? "shading/shadows/shadow_mask.frag" : "shading/shadows/shadow_map.frag",
        .cull = LOBE_CULL_NONE, // both sides of a sheet stop light
        .depth_test = true,
        .depth_write = true,
        .constants = &constants,
        .constants_size = sizeof constants,
        .specialisation = list.items,
        .specialisation_count = list.count,
        .bindings = bindings,
        .binding_count = binding_count,
    };
    passes_batch_set_counts(context, batch, DRAW_FOR_LIGHT, &draw);
    lobe_pass_draw(pass, &draw);
}

/// What the passes of all layers share.
typedef struct shadow_drawing {
    const filter_context *context;
    draw_list *draws;
    shadow_receivers receivers;
    uint32_t extent;
    float place[2]; ///< of samples in texels
    struct shadow_view *views;
    lobe_resource maps, slopes;
} shadow_drawing;

static void fill_view(const shadow_drawing *d, const shadow_camera *view,
                      struct shadow_view *result) {
    mat4 matrix;
    passes_shadow_projection(view, &d->receivers, d->extent, d->place, matrix);
    memcpy(result->world_to_clip, matrix, sizeof matrix);
    passes_shadow_tolerance(view, &d->receivers, d->extent, result->tolerance);
}

/// Each layer has its own constants, so that lights that have not changed keep theirs.
static void draw_layer(shadow_drawing *d, uint32_t layer) {
    lobe_graph *graph = d->context->graph;
    passes_culling_for_light(d->context, d->draws, d->views[layer].world_to_clip, d->extent);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_RASTER, "shadow_map");
    d->maps = lobe_pass_depth(pass, &(lobe_attachment){.resource = d->maps, .layer = layer});
    d->slopes =
        lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = d->slopes, .layer = layer});
    if (d->draws->batch_count == 0)
        return;
    lobe_pass_read(
        pass, &(lobe_binding){.name = "view_block",
                              .resource = lobe_graph_upload(graph, "shadow view", &d->views[layer],
                                                            sizeof d->views[layer])});
    for (size_t i = 0; i < d->draws->batch_count; i++)
        draw_batch(d->context, pass, &d->draws->batches[i]);
}

static void draw_layers(shadow_drawing *d) {
    const lobe_scene *scene = d->context->scene->scene;
    shadow_plan plan = passes_shadow_plan(d->context);
    for (uint32_t type = 0; type < 3; type++) {
        for (size_t i = 0; i < scene->light_count; i++) {
            const lobe_light *light = &scene->lights[i];
            if ((uint32_t)light->type != type)
                continue;
            const uint32_t first = plan.layers, count = passes_shadow_plan_take(&plan, light);
            for (uint32_t k = 0; k < count; k++) {
                const shadow_camera view = passes_shadow_view(light, k, &d->receivers, d->extent);
                fill_view(d, &view, &d->views[first + k]);
                draw_layer(d, first + k);
            }
        }
    }
}

// ---------------------------------------------------------------------------------------------

/// The plan after all lights.
static shadow_plan whole_plan(const filter_context *context) {
    const lobe_scene *scene = context->scene->scene;
    shadow_plan plan = passes_shadow_plan(context);
    for (uint32_t type = 0; type < 3; type++)
        for (size_t i = 0; i < scene->light_count; i++)
            if ((uint32_t)scene->lights[i].type == type)
                (void)passes_shadow_plan_take(&plan, &scene->lights[i]);
    return plan;
}

bool passes_shadow_maps_wanted(const filter_context *context) {
    return whole_plan(context).layers > 0;
}

void passes_shadow_maps_warn(const filter_context *context) {
    const shadow_plan plan = whole_plan(context);
    if (plan.missed > 0)
        lobe_host_log(context->host, LOBE_LOG_WARNING,
                      "%s: %u of %zu lights cast no shadow: maps of %u x %u texels have room for "
                      "%u layers, and a point light takes six",
                      context->scene->scene->name, plan.missed, context->scene->scene->light_count,
                      plan.extent, plan.extent, plan.room);
}

static shadow_maps no_shadows(const filter_context *context) {
    static const struct shadow_view none;
    const lobe_resource white = lobe_graph_import_texture(context->graph, context->scene->white);
    return (shadow_maps){.maps = white,
                         .slopes = white,
                         .views =
                             lobe_graph_upload(context->graph, "no shadows", &none, sizeof none)};
}

/// Texels of each sample lie elsewhere: a sequence of low discrepancy (Roberts 2018).
static void place_sample(const shading_sample *sample, float place[2]) {
    static const double steps[2] = {0.7548776662466927, 0.5698402909980532};
    for (int i = 0; i < 2; i++) {
        const double value = sample ? 0.5 + steps[i] * sample->number : 0.5;
        place[i] = (float)(value - floor(value));
    }
}

static lobe_resource layered_image(const shadow_drawing *d, const char *name, lobe_format format,
                                   uint32_t layers, bool retained) {
    return lobe_graph_image(d->context->graph, &(lobe_image_description){.name = name,
                                                                         .format = format,
                                                                         .width = d->extent,
                                                                         .height = d->extent,
                                                                         .layers = layers,
                                                                         .retained = retained});
}

shadow_maps passes_shadow_maps(const filter_context *context, draw_list *draws,
                               const shading_sample *sample) {
    const uint32_t layers = whole_plan(context).layers;
    if (layers == 0)
        return no_shadows(context);
    shadow_drawing d = {
        .context = context, .draws = draws, .extent = passes_shadow_plan(context).extent};
    float minimum[3], maximum[3];
    passes_drawn_bounds(context->scene, minimum, maximum);
    d.receivers = passes_shadow_receivers(&context->view, minimum, maximum);
    place_sample(sample, d.place);
    d.views = lobe_allocate(lobe_host_allocator(context->host), layers, sizeof *d.views);
    if (!d.views) {
        lobe_graph_fail(context->graph, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory for shadows",
                        context->scene->scene->name);
        return no_shadows(context);
    }
    d.maps = layered_image(&d, "shadow maps", LOBE_FORMAT_D32_FLOAT, layers, sample == NULL);
    d.slopes = layered_image(&d, "shadow slopes", LOBE_FORMAT_RG16_FLOAT, layers, sample == NULL);
    draw_layers(&d);
    const shadow_maps result = {.maps = d.maps,
                                .slopes = d.slopes,
                                .views = lobe_graph_upload(context->graph, "shadow views", d.views,
                                                           layers * sizeof *d.views),
                                .present = true};
    lobe_release(d.views);
    return result;
}
