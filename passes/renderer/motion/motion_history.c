#include "passes/renderer/motion/motion_history.h"

#include <string.h>

/// Twice as much as before, so that many that come one by one are not copied each time.
static bool reserve(motion_history *history, size_t count, const lobe_allocator *allocator) {
    const size_t twice = 2 * history->room, room = count > twice ? count : twice;
    if (count <= history->room)
        return true;
    float(*transforms)[16] =
        lobe_reallocate(allocator, history->transforms, room, sizeof *transforms);
    if (transforms)
        history->transforms = transforms;
    bool *known = lobe_reallocate(allocator, history->known, room, sizeof *known);
    if (known)
        history->known = known;
    history->room = transforms && known ? room : history->room;
    return transforms && known;
}

bool passes_motion_history_complete(motion_history *history, const lobe_scene *scene,
                                    const lobe_allocator *allocator) {
    if (!reserve(history, scene->instance_count, allocator) ||
        !passes_pose_history_reserve(&history->poses, scene, allocator))
        return false;
    for (size_t i = history->count; i < scene->instance_count; i++)
        history->known[i] = false;
    history->count = scene->instance_count;
    for (size_t i = 0; i < history->count; i++)
        if (!history->known[i])
            memcpy(history->transforms[i], scene->instances[i].transform,
                   sizeof history->transforms[i]);
    return true;
}

void passes_motion_history_keep(motion_history *history, const lobe_scene *scene,
                                const lobe_camera *camera) {
    history->has_camera = true;
    history->camera = *camera;
    for (size_t i = 0; i < history->count; i++) {
        history->known[i] = !scene->instances[i].hidden;
        memcpy(history->transforms[i], scene->instances[i].transform,
               sizeof history->transforms[i]);
    }
    passes_pose_history_keep(&history->poses, scene);
}

void passes_motion_history_update(motion_history *history, const lobe_scene *scene,
                                  const lobe_scene_changes *changes) {
    if (history->count > scene->instance_count)
        history->count = scene->instance_count;
    for (size_t i = 0; i < changes->instance_count; i++)
        if (changes->instances[i] < history->count)
            history->known[changes->instances[i]] = false;
    for (size_t i = 0; i < changes->mesh_count; i++)
        passes_pose_history_forget_mesh(&history->poses, changes->meshes[i]);
}

void passes_motion_history_forget(motion_history *history) {
    lobe_release(history->transforms);
    lobe_release(history->known);
    passes_pose_history_forget(&history->poses);
    *history = (motion_history){0};
}
