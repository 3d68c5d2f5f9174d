#include "passes/renderer/shading.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "passes/context/camera.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/displacement/drawn_bounds.h"
#include "passes/filters/material_shading.h"
#include "passes/renderer/accumulation.h"
#include "passes/renderer/background.h"
#include "passes/renderer/light_parts.h"
#include "passes/renderer/surfaces/surfaces.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/frame.h"
#include "shaders/interface/instance.h"
#include "shaders/interface/light.h"
#include "shaders/interface/specialisation.h"

/// What the passes of one picture share.
typedef struct shading {
    const filter_context *context;
    const draw_list *draws;
    const shading_sample *sample;
    const shading_selection *selection; ///< NULL: all pixels
    light_counts lights;                ///< of the scene
    seen_surfaces surfaces;
} shading;

/// What the draws of one pass share.
typedef struct drawing {
    const filter_context *context;
    const environment_light *light;
    const light_counts *lights;         ///< of the scene
    const shading_selection *selection; ///< NULL: all pixels
    bool depth_as_coverage;
    bool shadows;
    bool aov;
    const seen_surfaces *surfaces;
    bool deferred; ///< they come from their picture
    lobe_pass *pass;
} drawing;

static lobe_resource declare_target(lobe_graph *graph, const char *name, lobe_format format,
                                    uint32_t width, uint32_t height) {
    return lobe_graph_image(graph,
                            &(lobe_image_description){
                                .name = name, .format = format, .width = width, .height = height});
}

shading_targets passes_shading_targets_declare(lobe_graph *graph, uint32_t width, uint32_t height,
                                               bool aov) {
    shading_targets targets = {.width = width, .height = height};
    targets.radiance = declare_target(graph, "radiance", LOBE_FORMAT_RGBA32_FLOAT, width, height);
    targets.depth = declare_target(graph, "depth", LOBE_FORMAT_D32_FLOAT, width, height);
    if (aov) {
        targets.normal_depth =
            declare_target(graph, "normal and depth", LOBE_FORMAT_RGBA32_FLOAT, width, height);
        targets.lobes_level =
            declare_target(graph, "lobes and level", LOBE_FORMAT_RG32_FLOAT, width, height);
    }
    return targets;
}

static void fill_light(const lobe_light *source, struct light *light) {
    memset(light, 0, sizeof *light);
    float sign = source->type == LOBE_LIGHT_DIRECTIONAL ? -1.0f : 1.0f;
    for (int i = 0; i < 3; i++) {
        light->position[i] = source->position[i];
        light->direction[i] = sign * source->direction[i];
        light->intensity[i] = source->intensity[i];
    }
    light->position[3] = source->range > 0 ? 1 / (source->range * source->range) : 0;
    if (source->type != LOBE_LIGHT_SPOT)
        return;
    // KHR_lights_punctual: a smooth step in the cosine between the cones.
    float outer = cosf(source->outer_cone);
    light->cone[0] = 1 / fmaxf(0.001f, cosf(source->inner_cone) - outer);
    light->cone[1] = -outer * light->cone[0];
}

/// The lights of the part that begins at `cursor`, which moves behind it.
static lobe_resource upload_lights(const filter_context *context, light_cursor *cursor,
                                   light_part part) {
    const lobe_scene *scene = context->scene->scene;
    struct light lights[LIGHTS_PER_PASS] = {{.position = {0}}};
    for (uint32_t number = 0; number < part.count;) {
        if (cursor->index == scene->light_count) {
            cursor->type++;
            cursor->index = 0;
        }
        const lobe_light *light = &scene->lights[cursor->index++];
        if (light->type != cursor->type)
            continue;
        struct light *own = &lights[number++];
        fill_light(light, own);
        own->cone[2] = (float)cursor->shadows.layers;
        own->cone[3] = (float)passes_shadow_plan_take(&cursor->shadows, light);
    }
    return lobe_graph_upload(context->graph, "lights", lights, sizeof lights);
}

shading_light passes_shading_light_prepare(const filter_context *context,
                                           const environment_work *work) {
    shading_light light = {.further = {.shadows = passes_shadow_plan(context)},
                           .environment = passes_environment_light_build(context, work)};
    light.punctual = upload_lights(context, &light.further, passes_light_part(context, 0));
    return light;
}

const shading_sample passes_pixel_centre = {.position = {0.5f, 0.5f}, .footprint = 1};

struct frame_constants passes_frame_constants(const filter_context *context,
                                              const shading_sample *sample, uint32_t width,
                                              uint32_t height) {
    struct frame_constants frame = {.footprint = sample->footprint,
                                    .dither = sample->dither,
                                    .seed = sample->number + 0x9e3779b9u * sample->pattern,
                                    .vertex_spacing = context->scene->displaced_spacing};
    float minimum[3], maximum[3];
    mat4 matrix;
    passes_drawn_bounds(context->scene, minimum, maximum);
    passes_camera_projection(context->view.camera, width, height, sample->position, minimum,
                             maximum, matrix);
    memcpy(frame.world_to_clip, matrix, sizeof matrix);
    mat3 rotation;
    passes_camera_rotation(context->view.camera, rotation);
    glm_mat4_identity(matrix);
    glm_mat4_ins3(rotation, matrix);
    memcpy(frame.world_to_camera, matrix, sizeof matrix);
    vec4 vector;
    passes_camera_eye(context->view.camera, vector);
    memcpy(frame.eye, vector, sizeof vector);
    passes_camera_axis(context->view.camera, vector);
    memcpy(frame.axis, vector, sizeof vector);
    return frame;
}

/// None if no batch would read it.
static lobe_resource upload_frame(const shading *s, light_part lights,
                                  const shading_targets *targets) {
    if (s->draws->batch_count == 0)
        return (lobe_resource){0};
    struct frame_constants frame =
        passes_frame_constants(s->context, s->sample, targets->width, targets->height);
    frame.directional_count = passes_light_part_count(&s->lights, lights, LOBE_LIGHT_DIRECTIONAL);
    frame.point_count = passes_light_part_count(&s->lights, lights, LOBE_LIGHT_POINT);
    frame.spot_count = passes_light_part_count(&s->lights, lights, LOBE_LIGHT_SPOT);
    frame.first_light = lights.first;
    return lobe_graph_upload(s->context->graph, "frame", &frame, sizeof frame);
}

static bool draws_background(const filter_context *context, const environment_light *light) {
    return light->present && context->scene->scene->environment_visible;
}

static bool has_aov(const shading_targets *targets) {
    return targets->normal_depth.version || targets->normal_depth.index;
}

/// `begun`: some batches have been drawn.
static void attach_colours(lobe_pass *pass, const filter_context *context, bool begun,
                           shading_targets *targets) {
    const lobe_load load = begun ? LOBE_LOAD_KEEP : LOBE_LOAD_CLEAR;
    lobe_attachment radiance = {.resource = targets->radiance,
                                .load = targets->keep_radiance ? LOBE_LOAD_KEEP : load};
    if (!targets->without_background)
        memcpy(radiance.clear, context->scene->scene->background, 3 * sizeof(float));
    targets->radiance = lobe_pass_colour(pass, 0, &radiance);
    if (has_aov(targets)) {
        targets->normal_depth = lobe_pass_colour(
            pass, 1, &(lobe_attachment){.resource = targets->normal_depth, .load = load});
        targets->lobes_level = lobe_pass_colour(
            pass, 2, &(lobe_attachment){.resource = targets->lobes_level, .load = load});
    }
}

static void attach_depth(lobe_pass *pass, bool begun, shading_targets *targets) {
    const bool keep = begun || targets->keep_depth;
    targets->depth =
        lobe_pass_depth(pass, &(lobe_attachment){.resource = targets->depth,
                                                 .load = keep ? LOBE_LOAD_KEEP : LOBE_LOAD_CLEAR});
}

size_t passes_shading_draw_count(const draw_list *draws) {
    return FIRST_INSTANCE_DRAW + draws->batch_count;
}

const instance_batch *passes_shading_draw_batch(const draw_list *draws, size_t draw) {
    return draw < FIRST_INSTANCE_DRAW ? NULL : &draws->batches[draw - FIRST_INSTANCE_DRAW];
}

shading_draw_count passes_shading_draw_counts(const filter_context *context, const draw_list *draws,
                                              size_t draw) {
    if (draw < FIRST_INSTANCE_DRAW)
        return (shading_draw_count){.indices = 3, .instances = 1};
    const instance_batch *batch = &draws->batches[draw - FIRST_INSTANCE_DRAW];
    const seen_instances *seen = &batch->seen[DRAW_FOR_PICTURE];
    return (shading_draw_count){
        .indices = passes_batch_index_count(context->scene, batch),
        .instances = batch->count,
        .seen = seen->transforms.version > 0 ? 1 + seen->record : 0,
    };
}

/// The constants of a draw: for its material, its mesh, the lights and the settings.
static void specialise_draw(const drawing *d, const instance_batch *batch,
                            specialisation_list *list) {
    const device_scene *scene = d->context->scene;
    const device_instance *drawn = &scene->instances[batch->instance];
    passes_specialise(list, SPECIALISE_VERTEX_COLOUR, scene->scene->meshes[drawn->mesh].has_colour);
    passes_specialise(list, SPECIALISE_MIRRORED, batch->mirrored);
    passes_specialise(list, SPECIALISE_DISPLACED, batch->displaced.vertices.version > 0);
    passes_specialise(list, SPECIALISE_STRETCHED, passes_batch_map_width(d->context, batch) > 0);
    passes_specialise(list, SPECIALISE_HEIGHTS_TURNED,
                      d->context->filter->reads_heights &&
                          passes_heights_have_own_set(&scene->materials[drawn->material]));
    const uint32_t *of_type = d->lights->of_type;
    passes_specialise(list, SPECIALISE_DIRECTIONAL_LIGHTS, of_type[LOBE_LIGHT_DIRECTIONAL] > 0);
    passes_specialise(list, SPECIALISE_POINT_LIGHTS, of_type[LOBE_LIGHT_POINT] > 0);
    passes_specialise(list, SPECIALISE_SPOT_LIGHTS, of_type[LOBE_LIGHT_SPOT] > 0);
    uint32_t lights = (uint32_t)scene->scene->light_count;
    passes_specialise(list, SPECIALISE_LIGHTS_AT_ONCE,
                      passes_environment_light_lights_at_once(d->light, lights));
    passes_specialise(list, SPECIALISE_SHADOWS, d->shadows);
    passes_specialise(list, SPECIALISE_DEPTH_AS_COVERAGE, d->depth_as_coverage);
    passes_specialise(list, SPECIALISE_DEFERRED, d->deferred);
    passes_material_shading_specialise(d->context, d->light, &scene->materials[drawn->material],
                                       batch->appearance, list);
}

static size_t bind_draw(const drawing *d, const instance_batch *batch, lobe_binding *bindings) {
    const device_scene *scene = d->context->scene;
    const device_instance *drawn = &scene->instances[batch->instance];
    size_t count = 0;
    bindings[count++] = (lobe_binding){
        .name = "instance_block", .resource = passes_batch_transforms(batch, DRAW_FOR_PICTURE)};
    bindings[count++] = d->deferred
                            ? passes_surfaces_binding(d->surfaces)
                            : (lobe_binding){.name = "vertex_block",
                                             .resource = passes_batch_vertices(d->context, batch)};
    return count + passes_material_shading_bind(d->context, d->light,
                                                &scene->materials[drawn->material],
                                                batch->appearance, bindings + count);
}

/// The batch's triangles.
static void draw_triangles(const drawing *d, const instance_batch *batch, size_t index,
                           lobe_draw *draw) {
    draw->vertex_shader = "shading/shading.vert";
    draw->cull = passes_batch_cull(d->context->scene, batch);
    draw->depth_write = true;
    passes_batch_set_counts(d->context, batch, DRAW_FOR_PICTURE, draw);
    passes_selection_count(d->selection, FIRST_INSTANCE_DRAW + index, draw);
}

/// Where the picture of surfaces shows the batch.
static void draw_pictured(const drawing *d, lobe_draw *draw) {
    passes_surfaces_set_draw(draw);
    passes_selection_count(d->selection, MASK_DRAW, draw);
}

static void draw_batch(const drawing *d, const draw_list *draws, size_t index) {
    const filter_context *context = d->context;
    const instance_batch *batch = &draws->batches[index];
    const device_instance *drawn = &context->scene->instances[batch->instance];
    const device_material *material = &context->scene->materials[drawn->material];
    const struct draw_constants constants = {.first_instance = batch->first,
                                             .map_width = passes_batch_map_width(context, batch),
                                             .number = 1 + (uint32_t)index};
    lobe_binding bindings[2 + MATERIAL_SHADING_BINDINGS];
    size_t binding_count = bind_draw(d, batch, bindings);
    specialisation_list list = {.graph = context->graph};
    specialise_draw(d, batch, &list);
    char fragment_shader[SHADING_NAME_SIZE];
    passes_material_shading_name(context, d->light, material, d->aov, fragment_shader);
    lobe_draw draw = {
        .fragment_shader = fragment_shader,
        .depth_test = true,
        .constants = &constants,
        .constants_size = sizeof constants,
        .specialisation = list.items,
        .specialisation_count = list.count,
        .bindings = bindings,
        .binding_count = binding_count,
    };
    if (d->deferred)
        draw_pictured(d, &draw);
    else
        draw_triangles(d, batch, index, &draw);
    lobe_pass_draw(d->pass, &draw);
}

static void draw_background(const drawing *d, const shading_sample *sample, bool aov) {
    lobe_draw draw = {.depth_test = d->selection != NULL};
    passes_selection_count(d->selection, BACKGROUND_DRAW, &draw);
    passes_background(d->pass, d->context, d->light->cube, sample, aov, &draw);
}

/// What the draws of all instances read.
static void bind_pass(lobe_pass *pass, const shading *s, lobe_resource frame,
                      const shading_light *light) {
    if (s->draws->batch_count == 0)
        return;
    lobe_pass_read(pass, &(lobe_binding){.name = "frame_block", .resource = frame});
    lobe_pass_read(pass, &(lobe_binding){.name = "light_block", .resource = light->punctual});
    lobe_pass_read(pass, &(lobe_binding){.name = "shadow_maps", .resource = light->shadows.maps});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "shadow_slopes", .resource = light->shadows.slopes});
    lobe_pass_read(pass, &(lobe_binding){.name = "shadow_block", .resource = light->shadows.views});
    lobe_pass_read(pass, &(lobe_binding){.name = "surfaces", .resource = s->surfaces.layers});
    passes_knobs_bind(s->context, pass);
    passes_environment_light_bind(&light->environment, s->context, pass, s->sample);
}

/// A pass that shades batches by their triangles, or those that are in the picture of surfaces.
/// `begun`: some batches have been drawn, and the background.
static void draw_pass(shading *s, bool deferred, bool begun, lobe_resource frame,
                      const shading_light *light, shading_targets *targets) {
    const filter_context *context = s->context;
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_RASTER,
                                          s->selection ? "sample_shading" : "shading");
    bind_pass(pass, s, frame, light);
    attach_colours(pass, context, begun, targets);
    if (deferred)
        s->surfaces.numbers = lobe_pass_depth(
            pass, &(lobe_attachment){.resource = s->surfaces.numbers, .load = LOBE_LOAD_KEEP});
    else
        attach_depth(pass, begun, targets);
    const drawing d = {.context = context,
                       .light = &light->environment,
                       .lights = &s->lights,
                       .selection = s->selection,
                       .depth_as_coverage = targets->depth_as_coverage,
                       .shadows = light->shadows.present,
                       .aov = has_aov(targets),
                       .surfaces = &s->surfaces,
                       .deferred = deferred,
                       .pass = pass};
    if (s->selection && !deferred && (!begun || s->surfaces.open))
        passes_selection_mask(pass, s->selection, "shading/samples/sample_mask.frag");
    if (draws_background(context, &light->environment) && !targets->keep_radiance &&
        !targets->without_background && !begun)
        draw_background(&d, s->sample, d.aov);
    for (size_t i = 0; i < s->draws->batch_count; i++)
        if (passes_surfaces_show(context, &s->surfaces, &s->draws->batches[i], deferred))
            draw_batch(&d, s->draws, i);
}

/// Draws one part of the lights.
static void draw_part(shading *s, lobe_resource frame, const shading_light *light,
                      shading_targets *targets) {
    if (s->surfaces.present)
        draw_pass(s, true, false, frame, light, targets);
    if (!s->surfaces.present || !s->surfaces.holds_all)
        draw_pass(s, false, s->surfaces.present, frame, light, targets);
}

// ---------------------------------------------------------------------------------------------
// More lights than one pass draws

static lobe_resource copy_depth(lobe_graph *graph, lobe_resource from, lobe_resource to) {
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "depth_copy");
    return lobe_pass_copy(pass, from, (lobe_range){0}, to, (lobe_range){0});
}

/// What was drawn before hides surfaces in every pass. Drawing the first part overwrites it.
static lobe_resource keep_depth(lobe_graph *graph, bool kept, const shading_targets *targets) {
    return kept ? copy_depth(graph, targets->depth,
                             declare_target(graph, "depth before", LOBE_FORMAT_D32_FLOAT,
                                            targets->width, targets->height))
                : (lobe_resource){0};
}

/// The lights from `first` on, in a picture of their own. `depth`: drawn before; none: nothing is.
static lobe_resource draw_further(shading *s, const shading_light *light, uint32_t first,
                                  const shading_targets *targets, lobe_resource depth) {
    lobe_graph *graph = s->context->graph;
    const uint32_t width = targets->width, height = targets->height;
    shading_light punctual = *light;
    punctual.environment.present = false;
    shading_targets one = passes_shading_targets_declare(graph, width, height, false);
    one.without_background = true;
    one.keep_depth = depth.version > 0;
    lobe_pass *clear = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "clear");
    lobe_resource sum = lobe_pass_fill(
        clear, declare_target(graph, "further lights", LOBE_FORMAT_RGBA32_FLOAT, width, height),
        (lobe_range){0}, (float[4]){0});
    while (first < s->context->scene->scene->light_count) {
        const light_part part = passes_light_part(s->context, first);
        punctual.punctual = upload_lights(s->context, &punctual.further, part);
        if (one.keep_depth)
            one.depth = copy_depth(graph, depth, one.depth);
        draw_part(s, upload_frame(s, part, targets), &punctual, &one);
        sum = passes_accumulation(graph, one.radiance, sum, width, height);
        first += part.count;
    }
    return sum;
}

static void add_light(lobe_graph *graph, lobe_resource sum, shading_targets *targets) {
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_RASTER, "light_addition");
    const lobe_binding binding = {.name = "sum", .resource = sum};
    targets->radiance = lobe_pass_colour(
        pass, 0, &(lobe_attachment){.resource = targets->radiance, .load = LOBE_LOAD_KEEP});
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "shading/background.vert",
                                      .fragment_shader = "shading/lights/light_addition.frag",
                                      .index_count = 3,
                                      .blend = LOBE_BLEND_ADD,
                                      .bindings = &binding,
                                      .binding_count = 1});
}

/// Views of lobes and levels are the same for all lights.
static bool shows_light(const filter_context *context) {
    const uint32_t view = passes_knob_choice(context, &passes_knob_view);
    return view == VIEW_RADIANCE || view == VIEW_SAMPLES;
}

void passes_shading(const filter_context *context, const draw_list *draws,
                    const shading_light *light, const shading_sample *sample,
                    const shading_selection *selection, const seen_surfaces *surfaces,
                    shading_targets *targets) {
    shading s = {.context = context,
                 .draws = draws,
                 .sample = sample,
                 .selection = selection,
                 .lights = passes_light_counts(context->scene->scene)};
    const light_part first = passes_light_part(context, 0);
    const lobe_resource frame = upload_frame(&s, first, targets);
    s.surfaces = surfaces ? *surfaces : passes_surfaces(context, draws, frame, selection, targets);
    const bool several = shows_light(context) && first.count < context->scene->scene->light_count;
    const bool kept = s.surfaces.present ? !s.surfaces.holds_all : targets->keep_depth;
    const lobe_resource depth =
        several ? keep_depth(context->graph, kept, targets) : (lobe_resource){0};
    draw_part(&s, frame, light, targets);
    if (several)
        add_light(context->graph, draw_further(&s, light, first.count, targets, depth), targets);
}
