#ifndef SCENES_ANIMATION_RIG_H
#define SCENES_ANIMATION_RIG_H

#include <lobe/host.h>
#include <lobe/scene.h>

/// Frees everything and clears the pointer. NULL is allowed.
void scenes_rig_free(lobe_rig **rig);

/// Checks what a pose reads: every index and count, not the numbers. LOBE_ERROR_MALFORMED.
lobe_result scenes_rig_check(const lobe_scene *scene, const lobe_host *host);

/// The scene's lights are others now, which follow no node.
void scenes_rig_forget_lights(lobe_scene *scene);

#endif
