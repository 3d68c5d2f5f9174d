#ifndef PASSES_RENDERER_DELIVERY_H
#define PASSES_RENDERER_DELIVERY_H

#include "passes/renderer/renderer.h"
#include "passes/renderer/shading.h"

/// How a frame is submitted, and where its images go.
struct frame_delivery {
    const lobe_render_target *target;         ///< the host's images; NULL: our own
    const lobe_vulkan_submission *submission; ///< the host's; NULL: submit and wait
    bool reads_back;                          ///< images go to host memory, except the target's
    bool aov;                                 ///< with arbitrary output variables
    bool motion;                              ///< with motion, wherever it goes
    bool prepares;                            ///< nothing is submitted: only pipelines are made
};

/// The target's images in a frame's graph. All zero: there is no target.
typedef struct delivery_target {
    /// What is drawn into: those images, or where the viewport is a part of them, images of its
    /// size and of their formats.
    shading_targets drawn;
    lobe_resource radiance, depth, motion; ///< those of which the viewport is a part, or none
} delivery_target;

/// The delivery that the caller of lobe_renderer_render asks for.
frame_delivery passes_delivery_of(const lobe_render_parameters *parameters);

/// Imports the images of the delivery's target into the graph and takes over the extent of its
/// viewport. LOBE_ERROR_INVALID_ARGUMENT: the target has no radiance, a viewport that it does not
/// contain, or an extent that differs from the one asked for. Other errors in an image stay in the
/// graph.
lobe_result passes_delivery_import(rendering *r, const frame_delivery *delivery,
                                   delivery_target *imported);
/// Replaces the images in `targets` with those of the imported target that are drawn into.
void passes_delivery_replace(const delivery_target *imported, shading_targets *targets);
/// Copies what was drawn for a part of the host's images to its place, and replaces the images in
/// `targets` with the host's.
void passes_delivery_place(const rendering *r, const frame_delivery *delivery,
                           const delivery_target *imported, shading_targets *targets);

/// Makes the graph compute an image of ours, and read it back if the delivery does.
void passes_delivery_mark_output(const rendering *r, const frame_delivery *delivery,
                                 lobe_resource resource);

/// Prepares the graph, executes it, or submits it as the host requests, and adds its times: the
/// device's only if it waited for the frame. In that case it also saves maps of the environment
/// that were read back.
lobe_result passes_delivery_run(rendering *r, const frame_delivery *delivery, lobe_frame *frame);

/// Copies an image that was read back. LOBE_ERROR_INVALID_ARGUMENT: the host's passes replaced it
/// by one of another extent or format.
lobe_result passes_delivery_take_image(const rendering *r, lobe_resource resource,
                                       lobe_format format, lobe_image *image);

#endif
