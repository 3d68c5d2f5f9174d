#ifndef PASSES_FILTERS_SLOTS_H
#define PASSES_FILTERS_SLOTS_H

#include "passes/context/filter.h"

/// What filters prepared for a scene's materials: a slot for each filter, each value of the knobs
/// that decide its slots, and each material. Two views that alternate (side by side, a benchmark)
/// prepare each material once, whether they differ in the filter or in its knobs. NULL: none yet.
typedef struct filter_slots filter_slots;

/// Lets the context's filter prepare an instance's material, where it has not, and add the passes
/// that build the maps. If it cannot prepare, nothing is built and the frame fails.
void passes_filter_slots_build(filter_slots **slots, const filter_context *context, size_t instance,
                               filtered_appearance *appearance);

/// Lets filters save in a folder what the last frame read back, which has been waited for. NULL:
/// drops it.
void passes_filter_slots_save(filter_slots *slots, const lobe_graph *graph, const char *folder,
                              const lobe_host *host);

/// Forgets what was prepared for materials that have changed since. `scene` is the one they were
/// prepared for.
void passes_filter_slots_update(filter_slots *slots, const device_scene *scene);

/// Forgets everything and clears the pointer.
void passes_filter_slots_destroy(filter_slots **slots);

#endif
