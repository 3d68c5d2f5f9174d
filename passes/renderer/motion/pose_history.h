#ifndef PASSES_RENDERER_MOTION_POSE_HISTORY_H
#define PASSES_RENDERER_MOTION_POSE_HISTORY_H

#include <lobe/scene.h>

/// The pose of a mesh: its weights and joint matrices, one after the other.
typedef struct mesh_pose {
    bool known;
    size_t target_count, joint_count;
    float *numbers;
    size_t room; ///< of `numbers`
} mesh_pose;

/// The poses of a scene's meshes in the last frame with motion. All zero: there was none.
typedef struct pose_history {
    mesh_pose *meshes; ///< NULL until a mesh of the scene can be deformed
    size_t count;
} pose_history;

/// Makes room for the poses of all meshes. False: out of memory.
bool passes_pose_history_reserve(pose_history *history, const lobe_scene *scene,
                                 const lobe_allocator *allocator);
/// Takes over the poses; there must be room.
void passes_pose_history_keep(pose_history *history, const lobe_scene *scene);
/// Forgets the pose of a mesh that changed.
void passes_pose_history_forget_mesh(pose_history *history, uint32_t mesh);
/// Forgets everything.
void passes_pose_history_forget(pose_history *history);

/// Points `pose`, a copy of the mesh's deformation, to the pose that it had. False: that is
/// unknown, or the same as now.
bool passes_pose_history_find(const pose_history *history, const lobe_scene *scene, uint32_t mesh,
                              lobe_deformation *pose);

#endif
