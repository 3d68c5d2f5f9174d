#ifndef PASSES_RENDERER_SHADOWS_SHADOW_VIEWS_H
#define PASSES_RENDERER_SHADOWS_SHADOW_VIEWS_H

#include "passes/context/filter.h"

/// How a light sees the scene: as a camera does.

/// What shadows fall onto: the part of the scene's bounds that the picture may show, as the corners
/// of a solid around it, in the world.
typedef struct shadow_receivers {
    float corners[8][3];
    float minimum[3], maximum[3]; ///< of the scene
} shadow_receivers;

shadow_receivers passes_shadow_receivers(const filter_view *view, const float minimum[3],
                                         const float maximum[3]);

/// One for a directional light and for a spot of at most 75 degrees, else six.
uint32_t passes_shadow_view_count(const lobe_light *light);

/// View `index` of a light, for a square map of `extent` texels a side. A directional light's is as
/// small as holds the receivers, in steps of about 9 %, and moves with them in whole texels.
lobe_camera passes_shadow_view(const lobe_light *light, uint32_t index,
                               const shadow_receivers *receivers, uint32_t extent);

/// What a map's depths are compared with, see struct shadow_view.
void passes_shadow_tolerance(const lobe_camera *view, const shadow_receivers *receivers,
                             uint32_t extent, float tolerance[4]);

#endif
