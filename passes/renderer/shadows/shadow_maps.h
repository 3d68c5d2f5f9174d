#ifndef PASSES_RENDERER_SHADOWS_SHADOW_MAPS_H
#define PASSES_RENDERER_SHADOWS_SHADOW_MAPS_H

#include "passes/environment/light.h"
#include "passes/renderer/draw_list.h"

/// Depths that lights see, for the knob `shadows`. Each light has one layer or six; those that find
/// no room cast no shadow.

/// Which layers the lights have. Taken from in the order in which shading has the lights.
typedef struct shadow_plan {
    uint32_t extent; ///< texels a side; 0: no shadows
    uint32_t room;   ///< layers that there may be
    uint32_t layers; ///< taken so far
    uint32_t missed; ///< lights without a shadow for lack of room
} shadow_plan;

shadow_plan passes_shadow_plan(const filter_context *context);
/// Takes the layers of a light: returns their number, from plan->layers on before the call; 0: it
/// casts no shadow.
uint32_t passes_shadow_plan_take(shadow_plan *plan, const lobe_light *light);

/// Says how many lights cast no shadow for lack of room, if any do.
void passes_shadow_maps_warn(const filter_context *context);

/// Whether passes_shadow_maps draws any.
bool passes_shadow_maps_wanted(const filter_context *context);

typedef struct shadow_maps {
    lobe_resource maps;   ///< D32_FLOAT, a layer for each view
    lobe_resource slopes; ///< RG16_FLOAT, how these depths change, see shadow_slope.glsl
    lobe_resource views;  ///< buffer of struct shadow_view
    bool present;
} shadow_maps;

/// Adds the passes that draw them (`shadow_map`), one for each layer, from what `draws` draws. They
/// are kept while nothing moves; those of a sample of the reference (`sample`; NULL: none) are not,
/// as each has its texels at other places. Without shadows: what shading binds instead.
shadow_maps passes_shadow_maps(const filter_context *context, draw_list *draws,
                               const shading_sample *sample);

#endif
