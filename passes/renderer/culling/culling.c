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

/// Displaced surfaces are drawn one by one, and the host alone knows where vertices are that it
/// gives on the device.
static bool can_cull(const device_scene *scene, const instance_batch *batch) {
    const uint32_t mesh = scene->instances[batch->instance].mesh;
    return batch->displaced.vertices.version == 0 && !scene->scene->meshes[mesh].on_device;
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

/// The sides of the picture, a pixel farther out: of clip space, |x| <= w and |y| <= w. What is
/// behind the eye is behind one of them.
static struct culling_constants constants_of(const filter_context *context) {
    static const float centre[2] = {0.5f, 0.5f};
    const lobe_scene *scene = context->scene->scene;
    const filter_view *view = &context->view;
    const float wider[2] = {1 + 2 / (float)view->width, 1 + 2 / (float)view->height};
    struct culling_constants constants;
    mat4 matrix;
    passes_camera_projection(view->camera, view->width, view->height, centre, scene->minimum,
                             scene->maximum, matrix);
    for (int side = 0; side < 4; side++)
        for (int column = 0; column < 4; column++)
            constants.planes[side][column] =
                wider[side / 2] * matrix[column][3] +
                (side % 2 ? -matrix[column][side / 2] : matrix[column][side / 2]);
    return constants;
}

/// The bounds of a mesh as it is drawn: its vertices' own, unless a pose moves them.
static struct culled_batch describe(const device_scene *scene, const instance_batch *batch) {
    const uint32_t index = scene->instances[batch->instance].mesh;
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    const mesh_measures *measures = &scene->measures[index];
    struct culled_batch culled = {.first = batch->first,
                                  .count = batch->count,
                                  .index_count = passes_batch_index_count(scene, batch)};
    memcpy(culled.minimum, mesh->deformation ? mesh->minimum : measures->minimum,
           sizeof mesh->minimum);
    memcpy(culled.maximum, mesh->deformation ? mesh->maximum : measures->maximum,
           sizeof mesh->maximum);
    return culled;
}

/// Those of the batches [first, end), whose transforms are in one buffer, that can be culled.
/// `culled` has room for all.
static void cull(const filter_context *context, draw_list *list, uint32_t first, uint32_t end,
                 struct culled_batch *culled) {
    lobe_graph *graph = context->graph;
    const instance_batch *last = &list->batches[end - 1];
    const uint32_t transforms_end = last->first + last->count;
    uint32_t count = 0;
    for (uint32_t i = first; i < end; i++)
        if (can_cull(context->scene, &list->batches[i]))
            culled[count++] = describe(context->scene, &list->batches[i]);
    if (count == 0)
        return;
    const struct culling_constants constants = constants_of(context);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "culling");
    lobe_pass_read(pass, &(lobe_binding){.name = "batch_block",
                                         .resource = lobe_graph_upload(graph, "batches", culled,
                                                                       count * sizeof *culled)});
    lobe_pass_read(pass, &(lobe_binding){.name = "transform_block",
                                         .resource = list->batches[first].transforms});
    const lobe_buffer_description seen = {.name = "transforms of what is seen",
                                          .size =
                                              transforms_end * sizeof(struct instance_constants)};
    const lobe_buffer_description arguments = {.name = "arguments of what is seen",
                                               .size = count * sizeof(lobe_draw_arguments)};
    const lobe_resource transforms = lobe_pass_write(
        pass, &(lobe_binding){.name = "seen_block", .resource = lobe_graph_buffer(graph, &seen)});
    const lobe_resource drawn =
        lobe_pass_write(pass, &(lobe_binding){.name = "argument_block",
                                              .resource = lobe_graph_buffer(graph, &arguments)});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "culling/culling.comp",
                                              .threads = {count * CULLING_THREADS, 1, 1},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    for (uint32_t i = first, record = 0; i < end; i++)
        if (can_cull(context->scene, &list->batches[i]))
            list->batches[i].seen = (seen_instances){transforms, drawn, record++};
}

void passes_culling(const filter_context *context, draw_list *list) {
    const lobe_allocator *allocator = lobe_host_allocator(context->host);
    if (!pays(context->scene, list))
        return;
    struct culled_batch *culled = lobe_allocate(allocator, list->batch_count, sizeof *culled);
    if (!culled) {
        lobe_graph_fail(context->graph, LOBE_ERROR_OUT_OF_MEMORY, "culling: out of memory");
        return;
    }
    for (uint32_t first = 0, end = 0; first < list->batch_count; first = end) {
        const lobe_resource transforms = list->batches[first].transforms;
        while (end < list->batch_count && end - first < MOST_BATCHES &&
               list->batches[end].transforms.index == transforms.index &&
               list->batches[end].transforms.version == transforms.version)
            ++end;
        cull(context, list, first, end, culled);
    }
    lobe_release(culled);
}
