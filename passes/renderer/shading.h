#ifndef PASSES_RENDERER_SHADING_H
#define PASSES_RENDERER_SHADING_H

#include "passes/context/filter.h"
#include "passes/environment/light.h"
#include "passes/renderer/draw_list.h"
#include "passes/renderer/samples/selection.h"
#include "passes/renderer/shadows/shadow_maps.h"
#include "passes/renderer/surfaces/surfaces.h"
#include "passes/renderer/surfaces/targets.h"

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

/// The only sample of a pixel.
extern const shading_sample passes_pixel_centre;

/// The constants of a picture of `width` x `height` pixels, without lights.
struct frame_constants passes_frame_constants(const filter_context *context,
                                              const shading_sample *sample, uint32_t width,
                                              uint32_t height);

/// Adds the passes that draw all instances with the filter's shader: one, unless there are many
/// lights (passes/renderer/light_parts.h).
/// `selection`: NULL: all pixels. `surfaces`: those of the same draws, sample and targets; NULL:
/// they are drawn here, where shading is deferred.
void passes_shading(const filter_context *context, const draw_list *draws,
                    const shading_light *light, const shading_sample *sample,
                    const shading_selection *selection, const seen_surfaces *surfaces,
                    shading_targets *targets);

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
