#ifndef PASSES_RENDERER_SHADING_H
#define PASSES_RENDERER_SHADING_H

#include "passes/context/filter.h"
#include "passes/environment/light.h"
#include "passes/renderer/draw_list.h"
#include "passes/renderer/shadows/shadow_maps.h"

/// What the shading pass draws into. passes_shading_targets_declare declares the images; each
/// shading pass clears them and stores their new versions here.
typedef struct shading_targets {
    uint32_t width, height;
    lobe_resource radiance;     ///< RGBA32_FLOAT: linear RGB radiance, coverage
    lobe_resource depth;        ///< D32_FLOAT
    lobe_resource normal_depth; ///< RGBA32_FLOAT; none without AOVs
    lobe_resource lobes_level;  ///< RG32_FLOAT; none without AOVs
    lobe_resource motion;       ///< RG32_FLOAT; none without motion
    /// Draw over the contents of radiance, depth and motion instead of clearing them.
    bool keep_radiance, keep_depth, keep_motion;
    /// Leave radiance black where nothing is hit: the picture is later blended over another.
    bool without_background;
    /// The radiance's alpha is the depth of what is hit (as in `depth`; above 0) instead of 1.
    bool depth_as_coverage;
} shading_targets;

/// The pixels that a shading pass draws: those that take more than one sample.
typedef struct shading_selection {
    lobe_resource counts;    ///< R32_FLOAT: samples of each pixel
    lobe_resource occluder;  ///< D32_FLOAT: hides what lies behind it; all zero: nothing is hidden
    lobe_resource arguments; ///< lobe_draw_arguments of each of the pass's draws, in order
    size_t first_argument;   ///< index of the first draw's
} shading_selection;

shading_targets passes_shading_targets_declare(lobe_graph *graph, uint32_t width, uint32_t height,
                                               bool aov);

/// A place in a scene's lights, sorted by type.
typedef struct light_cursor {
    lobe_light_type type;
    size_t index;        ///< of the scene's
    shadow_plan shadows; ///< of the lights before
} light_cursor;

/// Everything that lights the scene, shared by all shading passes of a frame.
typedef struct shading_light {
    lobe_resource punctual; ///< those that the pass draws, sorted by type
    light_cursor further;   ///< the first of those that it does not
    environment_light environment;
    shadow_maps shadows; ///< of the sample that is drawn next
} shading_light;

/// Without shadows: these need the draws (passes_shadow_maps).
shading_light passes_shading_light_prepare(const filter_context *context,
                                           const environment_work *work);

/// The constants of a picture of `width` x `height` pixels, without lights.
struct frame_constants passes_frame_constants(const filter_context *context,
                                              const shading_sample *sample, uint32_t width,
                                              uint32_t height);

/// Adds the passes that draw all instances with the filter's shader: one, unless there are many
/// lights (passes/renderer/light_parts.h).
/// `selection`: NULL: all pixels.
void passes_shading(const filter_context *context, const draw_list *draws,
                    const shading_light *light, const shading_sample *sample,
                    const shading_selection *selection, shading_targets *targets);

/// Of the height map, the object's lengths, if the filter's slopes follow how it is stretched; 0:
/// they do not.
float passes_shading_map_width(const filter_context *context, const instance_batch *batch);

/// A draw takes its counts from those of a selection; NULL: as it is.
void passes_shading_select_batch(const shading_selection *selection, size_t batch, lobe_draw *draw);
/// A draw over the whole picture, if any pixels are selected.
void passes_shading_select_picture(const shading_selection *selection, lobe_draw *draw);
/// Lets through the selected pixels alone: all others get the nearest depth. `shader`: writes it.
void passes_shading_draw_mask(lobe_pass *pass, const shading_selection *selection,
                              const char *shader);

/// What a draw draws.
typedef struct shading_draw_count {
    uint32_t indices; ///< or vertices
    uint32_t instances;
    uint32_t seen; ///< 1 + the batch's record among what the picture may show; 0: all instances
} shading_draw_count;

/// The number of draws of a shading pass with a selection, and what each draws.
size_t passes_shading_draw_count(const draw_list *draws);
/// The batch of a draw; NULL: it has none.
const instance_batch *passes_shading_draw_batch(const draw_list *draws, size_t draw);
shading_draw_count passes_shading_draw_counts(const filter_context *context, const draw_list *draws,
                                              size_t draw);

#endif
