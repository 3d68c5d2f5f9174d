#ifndef PASSES_RENDERER_MOTION_MOTION_HISTORY_H
#define PASSES_RENDERER_MOTION_MOTION_HISTORY_H

#include <lobe/renderer.h>

#include "passes/renderer/motion/pose_history.h"

/// What the last frame with motion drew, and where. All zero: there was none.
typedef struct motion_history {
    bool has_camera;
    lobe_camera camera;
    float (*transforms)[16]; ///< one for each instance
    bool *known;             ///< one for each: it has a transform there
    size_t count, room;      ///< instances, and how many the arrays hold
    pose_history poses;
} motion_history;

/// Gives all of the scene's instances a transform: those that were not drawn, that of this frame.
/// Makes room for poses.
/// False: out of memory.
bool passes_motion_history_complete(motion_history *history, const lobe_scene *scene,
                                    const lobe_allocator *allocator);
/// Takes over what was drawn.
void passes_motion_history_keep(motion_history *history, const lobe_scene *scene,
                                const lobe_camera *camera);
/// Forgets the instances and meshes that are listed as changed, and instances that the scene no
/// longer has.
void passes_motion_history_update(motion_history *history, const lobe_scene *scene,
                                  const lobe_scene_changes *changes);
/// Forgets everything.
void passes_motion_history_forget(motion_history *history);

#endif
