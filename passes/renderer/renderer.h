#ifndef PASSES_RENDERER_RENDERER_H
#define PASSES_RENDERER_RENDERER_H

#include <stdatomic.h>

#include <lobe/renderer.h>

#include "passes/context/fit_work.h"
#include "passes/displacement/displacement.h"
#include "passes/environment/light.h"
#include "passes/filters/slots.h"
#include "passes/maps/seen_tiles.h"
#include "passes/renderer/draw_list.h"
#include "passes/renderer/motion/motion_history.h"
#include "passes/renderer/surfaces/surfaces.h"

struct lobe_renderer {
    lobe_device *device;
    lobe_host host;
    lobe_graph *graph;
    device_scene *scene;              ///< NULL: none is set
    filtered_appearance *appearances; ///< one per instance of the scene
    draw_list draws;
    uint32_t *first_marks; ///< one per material, then one per image: see passes/maps/seen_tiles.h
    lobe_resource *filtered_images;     ///< passes_filtered_images_count of them
    filter_slots *slots;                ///< what filters prepared for the scene's materials
    const lobe_filter *reported_filter; ///< whose limits were already reported for this scene
    uint32_t reported_shadows;          ///< the knob `shadows` when lights were last counted for it
    environment_state environment;
    bool fits_are_read_back; ///< by a frame that was not waited for
    motion_history motion;
    displacement *displacement;      ///< NULL: no frame of this scene has displaced anything
    lobe_content_giver give_content; ///< NULL: nobody does
    void *giver;                     ///< passed to it
};

/// The state of one call of lobe_renderer_render. `context` points into it: do not copy it.
typedef struct rendering {
    lobe_renderer *renderer;
    const lobe_render_parameters *parameters;
    filter_context context;
    environment_work environment;
    fit_work fits;
    lobe_settings settings;
    filtered_images images;
    tile_marks tile_marks;
    seen_surfaces surfaces; ///< by which tiles were marked; shading uses them again
    uint32_t width, height; ///< pixels
} rendering;

/// Warns about materials that the filter cannot fully represent, once per filter and scene.
void passes_instance_maps_warn(const rendering *r);

/// Takes what the host gives in this frame, moves what moves, and fills the renderer's draws;
/// instances share maps where the filter allows it.
void passes_instances_list(rendering *r);

/// Then adds the passes that build the filter's maps for every instance. Fills the frame's sizes of
/// the maps. `targets`: what a picture will be drawn into, if one is.
void passes_instance_maps_build(rendering *r, shading_targets *targets, lobe_frame *frame);

/// Checks the parameters, fills the context, saves what the last frame read back, and loads what
/// this one needs of the environment.
lobe_result passes_rendering_begin(rendering *r);

/// Makes the maps that are fitted to materials, in one submission for each part of the work. How
/// many there are shows when they are declared. `*stopped`: `progress` (may be NULL) returned
/// false. Otherwise the graph is left with all maps declared.
lobe_result passes_fits_make(rendering *r, lobe_frame *frame,
                             bool (*progress)(void *user, double part), void *user, bool *stopped);

/// Saves the fitted maps that the last frame read back. It must have been waited for.
void passes_fits_save(rendering *r);

/// See passes/renderer/delivery.h.
typedef struct frame_delivery frame_delivery;

/// Draws one picture in one submission: a single shading pass, sampled at the pixels' centres.
lobe_result passes_frame_render(rendering *r, const frame_delivery *delivery, lobe_frame *frame);

/// Renders the reference: the mean of many samples per pixel, taken in several submissions.
lobe_result passes_reference_render(rendering *r, const frame_delivery *delivery,
                                    lobe_frame *frame);

/// As lobe_renderer_prepare, until `*stopped` (NULL: never), which another thread may set.
lobe_result passes_renderer_prepare(lobe_renderer *renderer,
                                    const lobe_render_parameters *parameters,
                                    const atomic_bool *stopped);

/// Uploads materials that a pose has moved. Errors: as lobe_renderer_update_scene.
lobe_result passes_renderer_follow_pose(lobe_renderer *renderer);

#endif
