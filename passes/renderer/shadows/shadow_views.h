#ifndef PASSES_RENDERER_SHADOWS_SHADOW_VIEWS_H
#define PASSES_RENDERER_SHADOWS_SHADOW_VIEWS_H

#include <cglm/cglm.h>

#include "passes/context/filter.h"

/// How a light sees the scene: as a camera does.

typedef struct shadow_camera {
    lobe_camera camera;
    float aspect; ///< what it sees: width over height
} shadow_camera;

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
/// narrow and as low as holds the receivers, each in steps of about 9 %, and moves with them in
/// whole texels: on a plane, a low light's texels are not longer than those of a high one.
shadow_camera passes_shadow_view(const lobe_light *light, uint32_t index,
                                 const shadow_receivers *receivers, uint32_t extent);

/// World to clip space. `place`: of the samples in texels, [0, 1).
void passes_shadow_projection(const shadow_camera *view, const shadow_receivers *receivers,
                              uint32_t extent, const float place[2], mat4 world_to_clip);

/// What a map's depths are compared with, see struct shadow_view.
void passes_shadow_tolerance(const shadow_camera *shadow, const shadow_receivers *receivers,
                             uint32_t extent, float tolerance[4]);

#endif
