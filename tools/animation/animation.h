#ifndef TOOLS_ANIMATION_H
#define TOOLS_ANIMATION_H

#include <lobe/device.h>
#include <lobe/renderer.h>
#include <lobe/scene.h>

/// The map of a scene that changes with time: a compute pass writes it in each frame, from the
/// scene's own map and the time alone.
typedef struct animation animation;

/// Prepares the map of a scene that is `on_device` (see tools/scenes/animated_scene.h): its texels
/// become those at time 0, as an example for filters. `*result` is NULL if the scene has none. The
/// device must live longer than the animation.
lobe_result animation_create(lobe_device *device, lobe_scene *scene, const lobe_host *host,
                             animation **result);
/// Clears the pointer; NULL is allowed.
void animation_destroy(animation **animation);

/// Lets the renderer draw the scene; it must not draw it once the animation is destroyed.
/// `animation`: NULL for a scene that stands still.
void animation_attach(animation *animation, lobe_renderer *renderer);

/// For all frames from now on. `seconds`: [0, ANIMATION_MAXIMUM_SECONDS]; 0 at first. `animation`
/// may be NULL.
void animation_set_time(animation *animation, double seconds);

/// 0 for a scene that stands still (NULL).
double animation_time(const animation *animation);

/// Beyond that, single precision would show in the motion.
#define ANIMATION_MAXIMUM_SECONDS 3600

#endif
