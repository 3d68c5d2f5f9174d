#ifndef PASSES_FILTERS_SLOTS_H
#define PASSES_FILTERS_SLOTS_H

#include "passes/context/filter.h"

/// What filters prepared for a scene's materials: a slot for each filter, each value of the knobs
/// that decide its slots, and each material. Two views that alternate (side by side, a benchmark)
/// prepare each material once, whether they differ in the filter or in its knobs. NULL: none yet.
typedef struct filter_slots filter_slots;

/// Lets the context's filter prepare a material, and returns what it keeps for it; NULL: nothing.
/// Errors: those of the filter's `prepare`, LOBE_ERROR_OUT_OF_MEMORY; not logged.
lobe_result passes_filter_slots_prepare(filter_slots **slots, const filter_context *context,
                                        uint32_t material, const void **prepared);

/// Forgets what was prepared for materials that have changed since. `scene` is the one they were
/// prepared for.
void passes_filter_slots_update(filter_slots *slots, const device_scene *scene);

/// Forgets everything and clears the pointer.
void passes_filter_slots_destroy(filter_slots **slots);

#endif
