#ifndef PASSES_RENDERER_LIGHT_PARTS_H
#define PASSES_RENDERER_LIGHT_PARTS_H

#include "passes/context/filter.h"

#define LIGHT_TYPES 3

typedef struct light_counts {
    uint32_t of_type[LIGHT_TYPES]; ///< by lobe_light_type
} light_counts;

/// Consecutive lights of a scene's, sorted by type: those that one shading pass draws.
typedef struct light_part {
    uint32_t first, count;
} light_part;

light_counts passes_light_counts(const lobe_scene *scene);

/// The lights from `first` on that one pass may draw. No more than a device computes: lavapipe
/// silently ends the loops of a shader after 65535 iterations in total.
light_part passes_light_part(const filter_context *context, uint32_t first);

/// How many of a part's lights are of this type. `all`: of the whole scene.
uint32_t passes_light_part_count(const light_counts *all, light_part part, lobe_light_type type);

#endif
