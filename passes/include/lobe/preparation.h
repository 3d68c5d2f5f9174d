#ifndef LOBE_PREPARATION_H
#define LOBE_PREPARATION_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/api.h>
#include <lobe/renderer.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Pipelines, images and meshes of frames to come, made in a thread of lobe's while the renderers
/// of the device draw: what lobe_renderer_prepare does, without a call that takes seconds.
///
/// Begin one with a scene that has what will be new: at least one instance of each new material,
/// and the lights and the environment that it will be drawn with. Frames do not wait meanwhile,
/// unless they need a pipeline that is in the making. When `done` has been called, bring the new
/// things to the scene that is drawn (lobe_renderer_update_scene, lobe_renderer_set_scene): that
/// and the next frame compile nothing, and upload no image or mesh that the preparation has.
/// Destroy it once they have been drawn.
typedef struct lobe_preparation lobe_preparation;

/// Called once, in the preparation's thread: everything is made (LOBE_OK), or why it is not (errors
/// as of lobe_renderer_set_scene and lobe_renderer_prepare, which are logged in that thread, too).
/// Not called where the preparation was destroyed before. It must not destroy the preparation.
typedef void (*lobe_preparation_done)(void *user, lobe_result result);

typedef struct lobe_preparation_parameters {
    /// May share images, materials and meshes with a scene that is drawn. Neither it nor they may
    /// change until the preparation is done or destroyed, but the numbers that frames read anew
    /// (lights, camera, transforms) of *other* scenes may. It must outlive the preparation.
    const lobe_scene *scene;
    /// At least one: what frames will be rendered with. Copied, but not what they point to, which
    /// must stay until the preparation is done or destroyed. Their `host.progress` and
    /// `host.add_passes` are called in the preparation's thread; a progress that returns false ends
    /// its frame's part, with LOBE_OK.
    const lobe_render_parameters *frames;
    size_t frame_count;
    /// Gives the scene's content on the device, as lobe_renderer_set_content_giver does. Called in
    /// the preparation's thread. NULL: the scene has none.
    lobe_content_giver give_content;
    void *giver;                ///< passed to it
    lobe_preparation_done done; ///< NULL: nobody is told; see lobe_preparation_is_done
    void *user;                 ///< passed to it
} lobe_preparation_parameters;

/// Begins to prepare, and returns at once. `host` as of lobe_renderer_create; its `write` and the
/// device's allocator are called in the preparation's thread, and so are the queue's lock and
/// unlock of an imported device. Signals of the process are not delivered to that thread. Destroy
/// the preparation before the device. Errors: LOBE_ERROR_INVALID_ARGUMENT (no scene, no frame),
/// LOBE_ERROR_OUT_OF_MEMORY, LOBE_ERROR_LIMIT (the system has no thread).
LOBE_API lobe_result lobe_preparation_begin(lobe_device *device,
                                            const lobe_preparation_parameters *parameters,
                                            const lobe_host *host, lobe_preparation **preparation);

/// Whether everything was made, or an error came; `*result` (may be NULL) is then the result. For
/// hosts that ask once a frame instead of waiting for `done`, which has been called by then. Any
/// thread may ask.
LOBE_API bool lobe_preparation_is_done(const lobe_preparation *preparation, lobe_result *result);

/// Ends and frees a preparation. Where it is not done, this waits for the pipeline that is in the
/// making, or until the scene is uploaded. Pipelines that were made stay on the device.
LOBE_API void lobe_preparation_destroy(lobe_preparation **preparation);

#ifdef __cplusplus
}
#endif

#endif
