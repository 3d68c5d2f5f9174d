#ifndef TOOLS_VIEWER_SIDE_H
#define TOOLS_VIEWER_SIDE_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/renderer.h>

#include "tools/animation/animation.h"
#include "tools/viewer/graphics/target.h"

/// The output that is shown.
typedef enum viewer_output {
    VIEWER_RADIANCE, ///< or the output chosen by the knob "view"
    VIEWER_NORMAL,
    VIEWER_DEPTH,
} viewer_output;

#define VIEWER_MAXIMUM_PASSES 48

/// The times of passes of one name in the last finished frame.
typedef struct viewer_pass {
    char name[64];
    double milliseconds;
    uint32_t run, skipped, culled;
    bool first; ///< it ran for the first time as it is set: compiling its shaders is included
} viewer_pass;

/// The passes that have run, whose shaders the driver has compiled, as the filter is set.
typedef struct viewer_compiled {
    uint64_t shaders; ///< hash of what decides which shaders passes use
    char passes[VIEWER_MAXIMUM_PASSES][64];
    size_t pass_count;
} viewer_compiled;

/// One of the pictures to compare: a filter with its knobs, and its picture. A supersampling filter
/// refines its picture from frame to frame, through host memory; others draw into one of the
/// viewer's images.
typedef struct viewer_side {
    const lobe_filter *filter;
    lobe_settings settings;
    viewer_output output;
    lobe_renderer *renderer;
    animation *animation; ///< NULL: the scene stands still
    viewer_target target;
    bool stale;  ///< its inputs have changed since it was drawn
    bool failed; ///< it could not be drawn; tried again when something changes
    // For filters that supersample.
    lobe_texture *mean;
    lobe_image mean_image; ///< in host memory
    double *sum;           ///< of `samples` samples of every channel
    uint32_t samples, pattern, step;
    // The environment's filtered maps, which are made in parts.
    uint32_t parts;      ///< in a frame
    uint32_t parts_left; ///< after the last one
    // The same of the mixtures that are fitted to materials.
    uint32_t fit_parts, fit_parts_left;
    // Times.
    bool awaits_times;
    viewer_pass passes[VIEWER_MAXIMUM_PASSES];
    size_t pass_count;
    double milliseconds, former_milliseconds;
    viewer_compiled compiled;
} viewer_side;

/// Shared by both sides.
typedef struct viewer_view {
    const viewer_device *device;
    lobe_scene *scene;
    double seconds;   ///< the time in a scene that changes with time
    size_t animation; ///< which of the scene's; LOBE_ANIMATION_ALL: all
    lobe_camera camera;
    uint32_t width, height;   ///< pixels
    uint32_t maximum_samples; ///< at which refining ends
    const char *cache;        ///< folder of filtered environments; NULL: none
    const char *fit_cache;    ///< folder of fitted mixtures; NULL: none
    const lobe_host *host;
} viewer_view;

/// Whether its picture is the mean of many samples. Normals and depth are not: one sample is
/// enough.
bool viewer_side_supersamples(const viewer_side *side);

/// The caller sets filter and settings.
lobe_result viewer_side_open(const viewer_view *view, viewer_side *side);
/// Keeps filter and settings.
void viewer_side_close(const viewer_view *view, viewer_side *side);

/// Call when the scene or the extent has changed, and old pictures are unused.
lobe_result viewer_side_set_scene(const viewer_view *view, viewer_side *side);
lobe_result viewer_side_resize(const viewer_view *view, viewer_side *side);

/// Whether drawing would change its picture.
bool viewer_side_has_work(const viewer_view *view, const viewer_side *side);

/// If the filter supersamples and its picture can be refined: adds samples, and waits for them.
lobe_result viewer_side_refine(const viewer_view *view, viewer_side *side);
/// Other filters: records drawing if it is stale. After a failure the commands must not be
/// submitted.
lobe_result viewer_side_record(const viewer_view *view, viewer_side *side,
                               VkCommandBuffer commands);
/// Call when the recorded frame has been finished: reads its times.
lobe_result viewer_side_finish(viewer_side *side);

#endif
