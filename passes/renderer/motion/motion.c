#include "passes/renderer/motion/motion.h"

#include <math.h>
#include <string.h>

#include "passes/context/camera.h"
#include "passes/displacement/drawn_bounds.h"
#include "passes/renderer/culling/culling.h"
#include "passes/upload/device_mesh.h"
#include "passes/upload/number_check.h"
#include "shaders/interface/motion.h"

static lobe_result check_transform(const float transform[16], size_t instance,
                                   const lobe_host *host) {
    const number_owner owner = {host, "render", "previous transform", NULL, instance};
    lobe_result result =
        passes_check_numbers(&owner, "elements", transform, 16, -INFINITY, INFINITY);
    if (!result &&
        (transform[3] != 0 || transform[7] != 0 || transform[11] != 0 || transform[15] != 1))
        result = lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                                "render: the last row of previous transform %zu is (%g, %g, %g, "
                                "%g); expected (0, 0, 0, 1)",
                                instance, (double)transform[3], (double)transform[7],
                                (double)transform[11], (double)transform[15]);
    return result == LOBE_ERROR_MALFORMED ? LOBE_ERROR_INVALID_ARGUMENT : result;
}

lobe_result passes_motion_check(const lobe_render_motion *motion, const lobe_scene *scene,
                                const lobe_host *host) {
    lobe_result result =
        motion->previous_camera ? passes_camera_check(motion->previous_camera, host) : LOBE_OK;
    for (size_t i = 0; !result && motion->previous_transforms && i < scene->instance_count; i++)
        result = check_transform(motion->previous_transforms[i], i, host);
    return result;
}

lobe_resource passes_motion_declare(lobe_graph *graph, uint32_t width, uint32_t height) {
    return lobe_graph_image(graph, &(lobe_image_description){.name = "motion",
                                                             .format = LOBE_FORMAT_RG32_FLOAT,
                                                             .width = width,
                                                             .height = height});
}

// ---------------------------------------------------------------------------------------------
// Cameras

static const float centre_of_pixel[2] = {0.5f, 0.5f};

static void project(const filter_context *context, const lobe_camera *camera, bool jittered,
                    float matrix[16]) {
    lobe_camera still = *camera;
    float minimum[3], maximum[3];
    mat4 world_to_clip;
    passes_drawn_bounds(context->scene, minimum, maximum);
    if (!jittered)
        memset(still.jitter, 0, sizeof still.jitter);
    passes_camera_projection(&still, context->view.width, context->view.height, centre_of_pixel,
                             minimum, maximum, world_to_clip);
    memcpy(matrix, world_to_clip, sizeof world_to_clip);
}

static lobe_resource upload_constants(const filter_context *context, const motion_start *start) {
    struct motion_constants constants = {
        .half_extent = {0.5f * (float)context->view.width, 0.5f * (float)context->view.height}};
    project(context, context->view.camera, true, constants.world_to_clip);
    project(context, context->view.camera, false, constants.current);
    project(context, start->camera, false, constants.change);
    for (int i = 0; i < 16; i++)
        constants.change[i] -= constants.current[i];
    return lobe_graph_upload(context->graph, "motion", &constants, sizeof constants);
}

// ---------------------------------------------------------------------------------------------
// Draws

static void draw_background(const filter_context *context, lobe_pass *pass) {
    struct motion_background_constants constants = {0};
    passes_camera_directions(context->view.camera, context->view.width, context->view.height,
                             centre_of_pixel, constants.centre, constants.right, constants.down);
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "shading/background.vert",
                                      .fragment_shader = "shading/motion/motion_background.frag",
                                      .index_count = 3,
                                      .constants = &constants,
                                      .constants_size = sizeof constants});
}

/// Displaced vertices are others in each frame: these are those of this frame, where they were.
static lobe_resource import_previous_vertices(const filter_context *context,
                                              const instance_batch *batch) {
    const device_scene *scene = context->scene;
    if (batch->displaced.vertices.version > 0) {
        const lobe_resource before = scene->displaced[batch->instance].previous_vertices;
        return before.version > 0 ? before : batch->displaced.vertices;
    }
    return passes_device_mesh_import_previous(context->graph, scene,
                                              scene->instances[batch->instance].mesh);
}

static lobe_resource previous_transforms(const instance_batch *batch) {
    const seen_instances *seen = &batch->seen[DRAW_FOR_PICTURE];
    return seen->transforms.version > 0 ? seen->previous_transforms : batch->previous_transforms;
}

/// Only where this surface is the one that is seen: masks have cut their holes into the depth.
static void draw_batch(const filter_context *context, lobe_pass *pass,
                       const instance_batch *batch) {
    const device_scene *scene = context->scene;
    const struct draw_constants constants = {.first_instance = batch->first};
    const lobe_binding bindings[] = {
        {.name = "vertex_block", .resource = passes_batch_vertices(context, batch)},
        {.name = "previous_vertex_block", .resource = import_previous_vertices(context, batch)},
        {.name = "instance_block", .resource = passes_batch_transforms(batch, DRAW_FOR_PICTURE)},
        {.name = "previous_instance_block", .resource = previous_transforms(batch)},
    };
    lobe_draw draw = {
        .vertex_shader = "shading/motion/motion.vert",
        .fragment_shader = "shading/motion/motion.frag",
        .cull = passes_batch_cull(scene, batch),
        .depth_test = true,
        .depth_equal = true,
        .constants = &constants,
        .constants_size = sizeof constants,
        .bindings = bindings,
        .binding_count = sizeof bindings / sizeof *bindings,
    };
    passes_batch_set_counts(context, batch, DRAW_FOR_PICTURE, &draw);
    lobe_pass_draw(pass, &draw);
}

void passes_motion(const filter_context *context, draw_list *draws, const motion_start *start,
                   shading_targets *targets) {
    passes_draw_list_upload_previous(draws, context, start->transforms);
    passes_culling_of_previous(context, draws);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_RASTER, "motion");
    const bool keep = targets->keep_motion;
    targets->motion =
        lobe_pass_colour(pass, 0,
                         &(lobe_attachment){.resource = targets->motion,
                                            .load = keep ? LOBE_LOAD_KEEP : LOBE_LOAD_DISCARD});
    targets->depth = lobe_pass_depth(
        pass, &(lobe_attachment){.resource = targets->depth, .load = LOBE_LOAD_KEEP});
    if (!keep || draws->batch_count > 0)
        lobe_pass_read(pass, &(lobe_binding){.name = "motion_block",
                                             .resource = upload_constants(context, start)});
    if (!keep)
        draw_background(context, pass);
    for (size_t i = 0; i < draws->batch_count; i++)
        draw_batch(context, pass, &draws->batches[i]);
}
