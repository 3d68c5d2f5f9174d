#ifndef TOOLS_ANIMATION_H
#define TOOLS_ANIMATION_H

#include <lobe/device.h>
#include <lobe/renderer.h>
#include <lobe/scene.h>

/// What changes with time in a scene: a map, which a compute pass writes in each frame from the
/// scene's own map and the time alone; or the pose of its rig.
typedef struct animation animation;

/// Prepares the map of a scene that is `on_device` (see tools/scenes/animated_scene.h): its texels
/// become those at time 0, as an example for filters. Of a scene with animations, poses it to time
/// 0 of the first. `*result` is NULL if the scene has neither. Scene and device must live longer
/// than the animation.
lobe_result animation_create(lobe_device *device, lobe_scene *scene, const lobe_host *host,
                             animation **result);
/// Clears the pointer; NULL is allowed.
void animation_destroy(animation **animation);

/// Lets the renderer draw the scene; it must not draw it once the animation is destroyed.
/// `animation`: NULL for a scene that stands still.
void animation_attach(animation *animation, lobe_renderer *renderer);

/// For all frames from now on. `seconds`: [0, ANIMATION_MAXIMUM_SECONDS]; 0 at first. `animation`
/// may be NULL. Fails, with a message, where the scene has no such pose: it keeps the last.
lobe_result animation_set_time(animation *animation, double seconds);

/// Which of the rig's animations plays: an index, or LOBE_ANIMATION_ALL. Its time stays. Of a map
/// (and of NULL) there is one.
lobe_result animation_set_index(animation *animation, size_t index);
/// Finds one by its name, its index, or "all". LOBE_ERROR_NOT_FOUND, with a message, if a scene
/// with animations has none like that; of others, 0.
lobe_result animation_find(const lobe_scene *scene, const char *text, const lobe_host *host,
                           size_t *index);
size_t animation_index(const animation *animation);

/// Seconds until it repeats; 0: it does not.
double animation_duration(const animation *animation);

/// 0 for a scene that stands still (NULL).
double animation_time(const animation *animation);

/// Beyond that, single precision would show in the motion.
#define ANIMATION_MAXIMUM_SECONDS 3600

#endif
