#include "passes/renderer/renderer.h"

#include "passes/upload/scene_upload.h"

lobe_result lobe_renderer_create(lobe_device *device, const lobe_host *host,
                                 lobe_renderer **renderer) {
    if (renderer)
        *renderer = NULL;
    if (!device || !renderer)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_renderer_create: device and renderer must not be NULL");
    const lobe_allocator *allocator = lobe_device_allocator(device);
    *renderer = lobe_allocate(allocator, 1, sizeof **renderer);
    if (!*renderer)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "renderer: out of memory");
    (*renderer)->device = device;
    if (host)
        (*renderer)->host = *host;
    (*renderer)->host.allocator = allocator;
    lobe_result result = lobe_graph_create(device, &(*renderer)->graph);
    if (result != LOBE_OK)
        lobe_renderer_destroy(renderer);
    return result;
}

static void forget_scene(lobe_renderer *renderer) {
    passes_filter_slots_destroy(&renderer->slots);
    passes_displacement_destroy(&renderer->displacement);
    passes_device_scene_destroy(&renderer->scene);
    lobe_release(renderer->appearances);
    passes_draw_list_destroy(&renderer->draws);
    lobe_release(renderer->filtered_images);
    lobe_release(renderer->first_marks);
    renderer->appearances = NULL;
    renderer->filtered_images = NULL;
    renderer->first_marks = NULL;
    renderer->reported_filter = NULL;
    renderer->reported_shadows = 0;
    renderer->fits_are_read_back = false;
    passes_motion_history_forget(&renderer->motion);
    passes_environment_light_forget(&renderer->environment);
}

void lobe_renderer_destroy(lobe_renderer **renderer) {
    if (!renderer || !*renderer)
        return;
    forget_scene(*renderer);
    lobe_graph_destroy(&(*renderer)->graph);
    lobe_release(*renderer);
    *renderer = NULL;
}

/// What frames need for each instance. Twice as much as before, so that many that come one by one
/// are not copied each time.
static bool reserve_instances(lobe_renderer *renderer, size_t count) {
    const size_t twice = 2 * renderer->draws.room, room = count > twice ? count : twice;
    const lobe_allocator *allocator = renderer->host.allocator;
    if (count <= renderer->draws.room)
        return true;
    filtered_appearance *appearances =
        lobe_reallocate(allocator, renderer->appearances, room, sizeof *appearances);
    if (!appearances)
        return false;
    renderer->appearances = appearances;
    return passes_draw_list_reserve(&renderer->draws, room, allocator);
}

lobe_result lobe_renderer_set_scene(lobe_renderer *renderer, const lobe_scene *scene) {
    if (!renderer)
        return LOBE_ERROR_INVALID_ARGUMENT;
    // A new graph: the former scene's retained maps must not be mistaken for maps of the new one.
    forget_scene(renderer);
    lobe_graph_destroy(&renderer->graph);
    lobe_result result = lobe_graph_create(renderer->device, &renderer->graph);
    if (result != LOBE_OK || !scene)
        return result;
    result = passes_device_scene_create(renderer->device, renderer->graph, scene, &renderer->host,
                                        &renderer->scene);
    if (result != LOBE_OK)
        return result;
    renderer->filtered_images =
        lobe_allocate(renderer->host.allocator, passes_filtered_images_count(scene) + 1,
                      sizeof *renderer->filtered_images);
    renderer->first_marks =
        lobe_allocate(renderer->host.allocator, scene->material_count + scene->image_count + 1,
                      sizeof *renderer->first_marks);
    if (passes_draw_list_create(&renderer->draws, scene->mesh_count, renderer->host.allocator) &&
        reserve_instances(renderer, scene->instance_count) && renderer->filtered_images &&
        renderer->first_marks) {
        passes_device_scene_take_pose(renderer->scene);
        return LOBE_OK;
    }
    forget_scene(renderer);
    return lobe_host_fail(&renderer->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          scene->name);
}

/// What follows from an update of the scene's copy. Also after an error: it may have come when some
/// materials were already changed.
static void end_update(lobe_renderer *renderer) {
    passes_filter_slots_update(renderer->slots, renderer->scene);
    if (renderer->scene->torn)
        forget_scene(renderer);
}

lobe_result passes_renderer_follow_pose(lobe_renderer *renderer) {
    bool moved = false;
    const lobe_result result =
        renderer->scene ? passes_device_scene_follow_pose(renderer->scene, &renderer->host, &moved)
                        : LOBE_OK;
    if (moved)
        end_update(renderer);
    return result;
}

lobe_result lobe_renderer_update_scene(lobe_renderer *renderer, const lobe_scene_changes *changes) {
    if (!renderer || !changes)
        return lobe_host_fail(renderer ? &renderer->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_renderer_update_scene: renderer and changes must not be NULL");
    if (!renderer->scene)
        return lobe_host_fail(&renderer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "update: no scene is set");
    if (!reserve_instances(renderer, renderer->scene->scene->instance_count))
        return lobe_host_fail(&renderer->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              renderer->scene->scene->name);
    const lobe_result result =
        passes_device_scene_update(renderer->scene, changes, &renderer->host);
    if (result == LOBE_OK && changes->material_count > 0)
        renderer->reported_filter = NULL;
    if (result == LOBE_OK && changes->environment)
        passes_environment_light_invalidate(&renderer->environment);
    if (result == LOBE_OK)
        passes_motion_history_update(&renderer->motion, renderer->scene->scene, changes);
    end_update(renderer);
    return result;
}

void lobe_renderer_set_content_giver(lobe_renderer *renderer, lobe_content_giver give, void *user) {
    if (!renderer)
        return;
    renderer->give_content = give;
    renderer->giver = user;
}

lobe_graph *lobe_renderer_graph(lobe_renderer *renderer) {
    if (!renderer)
        return NULL;
    return renderer->graph;
}

void lobe_frame_free(lobe_frame *frame) {
    if (!frame)
        return;
    lobe_image_free(&frame->radiance);
    lobe_image_free(&frame->normal_depth);
    lobe_image_free(&frame->lobes_level);
    lobe_image_free(&frame->motion);
    lobe_release(frame->passes);
    *frame = (lobe_frame){0};
}
