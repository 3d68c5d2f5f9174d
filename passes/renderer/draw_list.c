#include "passes/renderer/draw_list.h"

#include <string.h>

#include "passes/upload/device_mesh.h"
#include "passes/upload/transform.h"

/// As many transforms as one buffer of a frame may hold (lobe_graph_upload).
enum { MOST_TRANSFORMS = (4 << 20) / sizeof(struct instance_constants) };

/// Of an instance that is not in the list.
#define NO_BATCH UINT32_MAX

bool passes_draw_list_create(draw_list *list, size_t meshes, const lobe_allocator *allocator) {
    *list = (draw_list){.of_mesh = lobe_allocate(allocator, meshes, sizeof *list->of_mesh)};
    return list->of_mesh != NULL;
}

bool passes_draw_list_reserve(draw_list *list, size_t room, const lobe_allocator *allocator) {
    if (room <= list->room)
        return true;
    instance_batch *batches =
        lobe_reallocate(allocator, list->batches, room, sizeof *list->batches);
    if (batches)
        list->batches = batches;
    uint32_t *batch_of = lobe_reallocate(allocator, list->batch_of, room, sizeof *list->batch_of);
    if (batch_of)
        list->batch_of = batch_of;
    struct instance_constants *transforms =
        lobe_reallocate(allocator, list->transforms, room, sizeof *list->transforms);
    if (transforms)
        list->transforms = transforms;
    const bool enough = batches && batch_of && transforms;
    list->room = enough ? room : list->room;
    return enough;
}

void passes_draw_list_destroy(draw_list *list) {
    lobe_release(list->batches);
    lobe_release(list->batch_of);
    lobe_release(list->of_mesh);
    lobe_release(list->transforms);
    *list = (draw_list){0};
}

void passes_draw_list_begin(draw_list *list, const device_scene *scene) {
    list->batch_count = 0;
    memset(list->of_mesh, 0, scene->scene->mesh_count * sizeof *list->of_mesh);
    for (size_t i = 0; i < scene->scene->instance_count; i++)
        list->batch_of[i] = NO_BATCH;
}

/// The batch of the mesh that the instance can join, 1 + its index; 0: none. Materials come one
/// after another: behind a batch of another one, there is none.
static uint32_t find_batch(const draw_list *list, const device_scene *scene,
                           const device_instance *instance, bool mirrored) {
    uint32_t number = list->of_mesh[instance->mesh];
    while (number > 0) {
        const instance_batch *batch = &list->batches[number - 1];
        if (scene->instances[batch->instance].material != instance->material)
            return 0;
        if (batch->mirrored == mirrored && batch->count < MOST_TRANSFORMS)
            return number;
        number = batch->next_of_mesh;
    }
    return 0;
}

static uint32_t add_batch(draw_list *list, size_t instance, bool mirrored,
                          const filtered_appearance *appearance) {
    list->batches[list->batch_count++] =
        (instance_batch){.instance = instance, .mirrored = mirrored, .appearance = appearance};
    return list->batch_count;
}

void passes_draw_list_add(draw_list *list, const device_scene *scene, size_t index,
                          const filtered_appearance *appearance, bool shared) {
    const device_instance *instance = &scene->instances[index];
    const bool mirrored =
        passes_transform_determinant(scene->scene->instances[index].transform) < 0;
    const bool displaced = scene->displaced && scene->displaced[index].vertices.version > 0;
    shared = shared && !displaced;
    uint32_t number = shared ? find_batch(list, scene, instance, mirrored) : 0;
    if (number == 0) {
        number = add_batch(list, index, mirrored, appearance);
        if (displaced)
            list->batches[number - 1].displaced = scene->displaced[index];
        if (shared) {
            list->batches[number - 1].next_of_mesh = list->of_mesh[instance->mesh];
            list->of_mesh[instance->mesh] = number;
        }
    }
    ++list->batches[number - 1].count;
    list->batch_of[index] = number - 1;
}

static void fill(const float transform[16], struct instance_constants *constants) {
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            constants->rows[row][column] = transform[4 * column + row];
}

static void find_starts(draw_list *list) {
    uint32_t start = 0;
    for (uint32_t i = 0; i < list->batch_count; i++) {
        list->batches[i].start = start;
        start += list->batches[i].count;
    }
}

/// In the order of their batches. `transforms`: one for each instance; NULL: the scene's.
static void fill_transforms(draw_list *list, const lobe_scene *scene,
                            const float (*transforms)[16]) {
    for (uint32_t i = 0; i < list->batch_count; i++)
        list->batches[i].count = 0;
    for (size_t i = 0; i < scene->instance_count; i++) {
        if (list->batch_of[i] == NO_BATCH)
            continue;
        instance_batch *batch = &list->batches[list->batch_of[i]];
        fill(transforms ? transforms[i] : scene->instances[i].transform,
             &list->transforms[batch->start + batch->count++]);
    }
}

/// Some of the transforms in one buffer: those of batches [first, end).
static lobe_resource upload(const draw_list *list, const filter_context *context, const char *name,
                            uint32_t first, uint32_t end) {
    const instance_batch *last = &list->batches[end - 1];
    const uint32_t start = list->batches[first].start;
    return lobe_graph_upload(context->graph, name, &list->transforms[start],
                             (last->start + last->count - start) * sizeof *list->transforms);
}

/// Where the batches end whose transforms fit into a buffer with those of `first`.
static uint32_t end_of_buffer(const draw_list *list, uint32_t first) {
    const uint32_t start = list->batches[first].start;
    uint32_t end = first + 1;
    while (end < list->batch_count &&
           list->batches[end].start + list->batches[end].count - start <= MOST_TRANSFORMS)
        ++end;
    return end;
}

void passes_draw_list_end(draw_list *list, const filter_context *context) {
    find_starts(list);
    fill_transforms(list, context->scene->scene, NULL);
    for (uint32_t first = 0, end; first < list->batch_count; first = end) {
        end = end_of_buffer(list, first);
        const lobe_resource transforms = upload(list, context, "transforms", first, end);
        for (uint32_t i = first; i < end; i++) {
            list->batches[i].transforms = transforms;
            list->batches[i].first = list->batches[i].start - list->batches[first].start;
        }
    }
}

void passes_draw_list_upload_previous(draw_list *list, const filter_context *context,
                                      const float (*transforms)[16]) {
    fill_transforms(list, context->scene->scene, transforms);
    for (uint32_t first = 0, end; first < list->batch_count; first = end) {
        end = end_of_buffer(list, first);
        const lobe_resource previous = upload(list, context, "previous transforms", first, end);
        for (uint32_t i = first; i < end; i++)
            list->batches[i].previous_transforms = previous;
    }
}

uint32_t passes_batch_index_count(const device_scene *scene, const instance_batch *batch) {
    return (uint32_t)scene->scene->meshes[scene->instances[batch->instance].mesh].index_count;
}

lobe_resource passes_batch_vertices(const filter_context *context, const instance_batch *batch) {
    const device_scene *scene = context->scene;
    if (batch->displaced.vertices.version > 0)
        return batch->displaced.vertices;
    return passes_device_mesh_import(context->graph, scene, scene->instances[batch->instance].mesh);
}

lobe_resource passes_batch_transforms(const instance_batch *batch, draw_view view) {
    const lobe_resource seen = batch->seen[view].transforms;
    return seen.version > 0 ? seen : batch->transforms;
}

void passes_batch_set_counts(const filter_context *context, const instance_batch *batch,
                             draw_view view, lobe_draw *draw) {
    const device_scene *scene = context->scene;
    draw->instance_count = batch->count;
    if (batch->displaced.vertices.version > 0) {
        draw->indices = batch->displaced.indices;
        draw->indirect = batch->displaced.arguments;
        return;
    }
    draw->indices = lobe_graph_import_buffer(
        context->graph, scene->indices[scene->instances[batch->instance].mesh]);
    draw->index_count = passes_batch_index_count(scene, batch);
    if (batch->seen[view].transforms.version > 0) {
        draw->indirect = batch->seen[view].arguments;
        draw->indirect_offset = batch->seen[view].record * sizeof(lobe_draw_arguments);
    }
}

lobe_cull passes_batch_cull(const device_scene *scene, const instance_batch *batch) {
    const device_material *material = &scene->materials[scene->instances[batch->instance].material];
    const lobe_cull outside = batch->mirrored ? LOBE_CULL_FRONT : LOBE_CULL_BACK;
    return material->material->double_sided ? LOBE_CULL_NONE : outside;
}

float passes_batch_map_width(const filter_context *context, const instance_batch *batch) {
    return context->filter->stretches_slopes ? context->scene->instances[batch->instance].map_width
                                             : 0;
}
