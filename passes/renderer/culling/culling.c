#include "passes/renderer/culling/culling.h"

#include <string.h>

#include "passes/context/camera.h"

enum {
    // What the pass costs is what about so many triangles cost that are not seen.
    LEAST_TRIANGLES = 1 << 14,
    LEAST_INSTANCES = 16,
    // Each takes a workgroup.
    MOST_BATCHES = 1 << 15,
};

/// A host that gives vertices on the device may leave the mesh's bounds at 0.
static bool has_bounds(const lobe_mesh *mesh) {
    for (int i = 0; i < 3; i++)
        if (mesh->minimum[i] < mesh->maximum[i])
            return true;
    return !mesh->on_device;
}

/// Displaced surfaces are drawn one by one, by patches that are culled as such.
static bool can_cull(const device_scene *scene, const instance_batch *batch) {
    const uint32_t mesh = scene->instances[batch->instance].mesh;
    return batch->displaced.vertices.version == 0 && has_bounds(&scene->scene->meshes[mesh]);
}

static bool pays(const device_scene *scene, const draw_list *list) {
    uint64_t triangles = 0, instances = 0;
    for (uint32_t i = 0; i < list->batch_count; i++) {
        const instance_batch *batch = &list->batches[i];
        if (!can_cull(scene, batch))
            continue;
        instances += batch->count;
        triangles += (uint64_t)batch->count * (passes_batch_index_count(scene, batch) / 3);
    }
    return instances >= LEAST_INSTANCES && triangles >= LEAST_TRIANGLES;
}

// ---------------------------------------------------------------------------------------------
// Views

/// What a view shows: the sides of its picture, a pixel farther out: of clip space, |x| <= w and
/// |y| <= w. What is behind the eye is behind one of them.
static void make_planes(const float world_to_clip[16], uint32_t width, uint32_t height,
                        float4 planes[4]) {
    const float wider[2] = {1 + 2 / (float)width, 1 + 2 / (float)height};
    for (int side = 0; side < 4; side++) {
        const float sign = side % 2 ? -1 : 1;
        for (int column = 0; column < 4; column++) {
            const float *clip = &world_to_clip[4 * column];
            planes[side][column] = wider[side / 2] * clip[3] + sign * clip[side / 2];
        }
    }
}

static void make_planes_of_picture(const filter_context *context, float4 planes[4]) {
    static const float centre[2] = {0.5f, 0.5f};
    const lobe_scene *scene = context->scene->scene;
    const filter_view *view = &context->view;
    mat4 matrix;
    passes_camera_projection(view->camera, view->width, view->height, centre, scene->minimum,
                             scene->maximum, matrix);
    make_planes((const float *)matrix, view->width, view->height, planes);
}

// ---------------------------------------------------------------------------------------------
// Passes

/// The culling of a list for a view.
typedef struct culling {
    const filter_context *context;
    draw_list *list;
    draw_view view;
    bool previous; ///< the transforms of the previous frame are wanted of what was found before
    struct culling_constants constants;
    struct culled_batch *culled; ///< room for all batches of the list
    lobe_resource arguments;     ///< version 0: no pass has written any
} culling;

/// The bounds of a mesh as it is drawn: its vertices' own, unless a pose moves them or the host
/// gives others.
static struct culled_batch describe(const device_scene *scene, const instance_batch *batch) {
    const uint32_t index = scene->instances[batch->instance].mesh;
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    const mesh_measures *measures = &scene->measures[index];
    const bool moves = mesh->deformation || mesh->on_device;
    struct culled_batch culled = {.first = batch->first,
                                  .count = batch->count,
                                  .index_count = passes_batch_index_count(scene, batch)};
    memcpy(culled.minimum, moves ? mesh->minimum : measures->minimum, sizeof mesh->minimum);
    memcpy(culled.maximum, moves ? mesh->maximum : measures->maximum, sizeof mesh->maximum);
    return culled;
}

static lobe_resource write_arguments(const culling *c, lobe_pass *pass) {
    const lobe_buffer_description all = {.name = "arguments of what is seen",
                                         .size =
                                             c->list->batch_count * sizeof(lobe_draw_arguments)};
    if (c->arguments.version > 0)
        return lobe_pass_modify(
            pass, &(lobe_binding){.name = "argument_block", .resource = c->arguments});
    return lobe_pass_write(pass,
                           &(lobe_binding){.name = "argument_block",
                                           .resource = lobe_graph_buffer(c->context->graph, &all)});
}

/// Adds the pass for `count` batches, whose transforms are in one buffer of `end`. `first`: of the
/// batches. Returns their transforms.
static lobe_resource add_pass(culling *c, const instance_batch *first, uint32_t count,
                              uint32_t end) {
    lobe_graph *graph = c->context->graph;
    const lobe_buffer_description seen = {.name = "transforms of what is seen",
                                          .size = end * sizeof(struct instance_constants)};
    const lobe_resource batches =
        lobe_graph_upload(graph, "batches", c->culled, count * sizeof *c->culled);
    const lobe_resource copied = c->previous ? first->previous_transforms : first->transforms;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "culling");
    lobe_pass_read(pass, &(lobe_binding){.name = "batch_block", .resource = batches});
    lobe_pass_read(pass, &(lobe_binding){.name = "transform_block", .resource = first->transforms});
    lobe_pass_read(pass, &(lobe_binding){.name = "copied_block", .resource = copied});
    const lobe_resource transforms = lobe_pass_write(
        pass, &(lobe_binding){.name = "seen_block", .resource = lobe_graph_buffer(graph, &seen)});
    c->arguments = write_arguments(c, pass);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "culling/culling.comp",
                                              .threads = {count * CULLING_THREADS, 1, 1},
                                              .constants = &c->constants,
                                              .constants_size = sizeof c->constants});
    c->constants.first_record += count;
    return transforms;
}

/// Culls those of the batches [first, end), whose transforms are in one buffer, that can be culled.
static void cull(culling *c, uint32_t first, uint32_t end) {
    instance_batch *batches = c->list->batches;
    const uint32_t first_record = c->constants.first_record;
    uint32_t count = 0;
    for (uint32_t i = first; i < end; i++)
        if (can_cull(c->context->scene, &batches[i]))
            c->culled[count++] = describe(c->context->scene, &batches[i]);
    if (count == 0)
        return;
    const lobe_resource transforms =
        add_pass(c, &batches[first], count, batches[end - 1].first + batches[end - 1].count);
    for (uint32_t i = first, record = first_record; i < end; i++) {
        seen_instances *seen = &batches[i].seen[c->view];
        if (!can_cull(c->context->scene, &batches[i]))
            continue;
        if (c->previous)
            seen->previous_transforms = transforms;
        else
            *seen = (seen_instances){.transforms = transforms, .record = record++};
    }
}

static void cull_in_buffers(culling *c) {
    const instance_batch *batches = c->list->batches;
    const uint32_t count = c->list->batch_count;
    for (uint32_t first = 0, end = 0; first < count; first = end) {
        const lobe_resource transforms = batches[first].transforms;
        while (end < count && end - first < MOST_BATCHES &&
               batches[end].transforms.index == transforms.index &&
               batches[end].transforms.version == transforms.version)
            ++end;
        cull(c, first, end);
    }
    for (uint32_t i = 0; !c->previous && i < count; i++)
        c->list->batches[i].seen[c->view].arguments = c->arguments;
}

static void run(culling *c) {
    if (c->list->draws_all || !pays(c->context->scene, c->list))
        return;
    c->culled = lobe_allocate(lobe_host_allocator(c->context->host), c->list->batch_count,
                              sizeof *c->culled);
    if (c->culled)
        cull_in_buffers(c);
    else
        lobe_graph_fail(c->context->graph, LOBE_ERROR_OUT_OF_MEMORY, "culling: out of memory");
    lobe_release(c->culled);
}

static void cull_picture(const filter_context *context, draw_list *list, bool previous) {
    culling c = {.context = context, .list = list, .view = DRAW_FOR_PICTURE, .previous = previous};
    make_planes_of_picture(context, c.constants.planes);
    run(&c);
}

void passes_culling(const filter_context *context, draw_list *list) {
    cull_picture(context, list, false);
}

void passes_culling_of_previous(const filter_context *context, draw_list *list) {
    cull_picture(context, list, true);
}

void passes_culling_for_light(const filter_context *context, draw_list *list,
                              const float world_to_clip[16], uint32_t extent) {
    culling c = {.context = context, .list = list, .view = DRAW_FOR_LIGHT};
    make_planes(world_to_clip, extent, extent, c.constants.planes);
    run(&c);
}
