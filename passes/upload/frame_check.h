#ifndef PASSES_UPLOAD_FRAME_CHECK_H
#define PASSES_UPLOAD_FRAME_CHECK_H

#include <lobe/scene.h>

/// Checks of what a host may change in a scene from frame to frame without announcing it. The first
/// error is logged in one line, and LOBE_ERROR_MALFORMED is returned.

/// The transform is finite, affine, and not degenerate.
lobe_result passes_check_transform(const lobe_scene *scene, size_t instance, const lobe_host *host);
/// Transforms, lights, bounds, background, and the environment's rotation and intensity.
lobe_result passes_check_frame(const lobe_scene *scene, const lobe_host *host);

#endif
