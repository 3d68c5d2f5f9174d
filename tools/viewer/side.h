#ifndef TOOLS_VIEWER_SIDE_H
#define TOOLS_VIEWER_SIDE_H

#include <stdbool.h>

#include <lobe/renderer.h>

#include "tools/viewer/graphics/target.h"

/// What of the scene is shown.
typedef enum viewer_output {
    VIEWER_RADIANCE, ///< or what the knob "view" asks for
    VIEWER_NORMAL,
    VIEWER_DEPTH,
} viewer_output;

#define VIEWER_MAXIMUM_PASSES 48

/// What passes of one name came to in the frame last finished.
typedef struct viewer_pass {
    char name[64];
    double milliseconds;
    uint32_t run, skipped, culled;
} viewer_pass;

/// One of the pictures that are compared: a filter with its knobs, and what it drew. A filter that
/// supersamples refines its picture from frame to frame, and is drawn through host memory; others
/// draw into an image that lobe is lent.
typedef struct viewer_side {
    const lobe_filter *filter;
    lobe_settings settings;
    viewer_output output;
    lobe_renderer *renderer;
    viewer_target target;
    bool stale;  ///< what it depends on has changed since it was drawn
    bool failed; ///< it could not be drawn; it is tried again when something changes
    // Where the filter supersamples.
    lobe_texture *mean;
    lobe_image mean_image; ///< in host memory
    double *sum;           ///< of `samples` samples of every channel
    uint32_t samples, pattern, step;
    // The environment's filtered maps, which are made part by part.
    uint32_t parts;      ///< in a frame
    uint32_t parts_left; ///< after the last one
    // Times.
    bool awaits_times;
    viewer_pass passes[VIEWER_MAXIMUM_PASSES];
    size_t pass_count;
    double milliseconds, former_milliseconds;
} viewer_side;

/// What both sides have in common.
typedef struct viewer_view {
    const viewer_device *device;
    const lobe_scene *scene;
    lobe_camera camera;
    uint32_t width, height;   ///< pixels
    uint32_t maximum_samples; ///< at which refining ends
    const char *cache;        ///< folder of filtered environments; NULL: none
    const lobe_host *host;
} viewer_view;

/// Whether its picture is the mean of many samples. Normals and depth never are: one sample shows
/// what they are.
bool viewer_side_supersamples(const viewer_side *side);

/// Filter and settings are set by the caller.
lobe_result viewer_side_open(const viewer_view *view, viewer_side *side);
/// Keeps filter and settings.
void viewer_side_close(const viewer_view *view, viewer_side *side);

/// The scene or the extent is another one: nobody uses what was drawn any more.
lobe_result viewer_side_set_scene(const viewer_view *view, viewer_side *side);
lobe_result viewer_side_resize(const viewer_view *view, viewer_side *side);

/// Whether drawing it would change its picture.
bool viewer_side_has_work(const viewer_view *view, const viewer_side *side);

/// Where the filter supersamples and there is something to refine: adds samples, and waits for
/// them.
lobe_result viewer_side_refine(const viewer_view *view, viewer_side *side);
/// Other filters: records the drawing, where it is stale. After a failure the commands must not be
/// submitted.
lobe_result viewer_side_record(const viewer_view *view, viewer_side *side,
                               VkCommandBuffer commands);
/// The frame that was recorded has been finished: takes over its times.
lobe_result viewer_side_finish(viewer_side *side);

#endif
