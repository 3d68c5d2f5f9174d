#ifndef PASSES_RENDERER_LIGHT_PARTS_H
#define PASSES_RENDERER_LIGHT_PARTS_H

#include "passes/context/filter.h"

/// Consecutive lights of a scene's, sorted by type: those that one shading pass draws.
typedef struct light_part {
    uint32_t first, count;
} light_part;

uint32_t passes_light_count(const lobe_scene *scene, lobe_light_type type);

/// The lights from `first` on that one pass may draw. No more than a device computes: lavapipe
/// silently ends the loops of a shader after 65535 iterations in total.
light_part passes_light_part(const filter_context *context, uint32_t first);

/// How many of a part's lights are of this type.
uint32_t passes_light_part_count(const lobe_scene *scene, light_part part, lobe_light_type type);

#endif
