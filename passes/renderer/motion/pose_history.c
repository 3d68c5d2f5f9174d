#include "passes/renderer/motion/pose_history.h"

#include <lobe/deformation.h>
#include <string.h>

#define MATRIX 16 ///< numbers

static size_t number_count(const lobe_deformation *deformation) {
    return deformation->target_count + MATRIX * deformation->joint_count;
}

static bool reserve_mesh(mesh_pose *pose, size_t count, const lobe_allocator *allocator) {
    if (count <= pose->room)
        return true;
    float *numbers = lobe_reallocate(allocator, pose->numbers, count, sizeof *numbers);
    if (!numbers)
        return false;
    pose->numbers = numbers;
    pose->room = count;
    return true;
}

static bool has_deformations(const lobe_scene *scene) {
    bool any = false;
    for (size_t i = 0; i < scene->mesh_count && !any; i++)
        any = scene->meshes[i].deformation != NULL;
    return any;
}

bool passes_pose_history_reserve(pose_history *history, const lobe_scene *scene,
                                 const lobe_allocator *allocator) {
    if (!history->meshes && has_deformations(scene)) {
        history->meshes = lobe_allocate(allocator, scene->mesh_count, sizeof *history->meshes);
        history->count = history->meshes ? scene->mesh_count : 0;
        if (!history->meshes)
            return false;
    }
    bool done = true;
    for (size_t i = 0; i < history->count && done; i++) {
        const lobe_deformation *deformation = scene->meshes[i].deformation;
        done =
            !deformation || reserve_mesh(&history->meshes[i], number_count(deformation), allocator);
    }
    return done;
}

static void keep_mesh(mesh_pose *pose, const lobe_deformation *deformation) {
    pose->known = deformation != NULL;
    if (!deformation)
        return;
    pose->target_count = deformation->target_count;
    pose->joint_count = deformation->joint_count;
    if (pose->target_count > 0)
        memcpy(pose->numbers, deformation->weights, pose->target_count * sizeof(float));
    if (pose->joint_count > 0)
        memcpy(pose->numbers + pose->target_count, deformation->joint_matrices,
               MATRIX * pose->joint_count * sizeof(float));
}

void passes_pose_history_keep(pose_history *history, const lobe_scene *scene) {
    for (size_t i = 0; i < history->count; i++)
        keep_mesh(&history->meshes[i], scene->meshes[i].deformation);
}

void passes_pose_history_forget_mesh(pose_history *history, uint32_t mesh) {
    if (mesh < history->count)
        history->meshes[mesh].known = false;
}

void passes_pose_history_forget(pose_history *history) {
    for (size_t i = 0; i < history->count; i++)
        lobe_release(history->meshes[i].numbers);
    lobe_release(history->meshes);
    *history = (pose_history){0};
}

static bool is_same(const mesh_pose *pose, const lobe_deformation *now) {
    return (pose->target_count == 0 ||
            !memcmp(pose->numbers, now->weights, pose->target_count * sizeof(float))) &&
           (pose->joint_count == 0 ||
            !memcmp(pose->numbers + pose->target_count, now->joint_matrices,
                    MATRIX * pose->joint_count * sizeof(float)));
}

bool passes_pose_history_find(const pose_history *history, const lobe_scene *scene, uint32_t mesh,
                              lobe_deformation *pose) {
    const lobe_deformation *now = scene->meshes[mesh].deformation;
    const mesh_pose *before = mesh < history->count ? &history->meshes[mesh] : NULL;
    if (!now || !before || !before->known || before->target_count != now->target_count ||
        before->joint_count != now->joint_count || is_same(before, now))
        return false;
    *pose = *now;
    pose->weights = before->numbers;
    pose->joint_matrices = (float(*)[MATRIX])(before->numbers + before->target_count);
    return true;
}
