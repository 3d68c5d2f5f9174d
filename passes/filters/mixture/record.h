#ifndef PASSES_FILTERS_MIXTURE_RECORD_H
#define PASSES_FILTERS_MIXTURE_RECORD_H

#include "passes/filters/mixture/mixture_map.h"

/// What is kept of a material's mixture from frame to frame, in a filter's slot: how much of it is
/// fitted, and what a cache folder has of it. Texels that replace others are fitted in one frame,
/// and not saved: they may change again in the next.

/// For lobe_filter.prepare: looks for the mixture in the frame's cache folder when it is first
/// needed, and takes as much of the frame's work as is left to do.
lobe_result passes_mixture_prepare(const filter_context *context, uint32_t material,
                                   const mixture_kind *kind, void **slot);
/// For lobe_filter.forget.
void passes_mixture_forget(void *slot);
/// For lobe_filter.save.
void passes_mixture_save(void *slot, const lobe_graph *graph, const char *folder,
                         const lobe_host *host);

/// Adds the passes that fit the mixture, or those that restore it. false: the material's lobes do
/// not vary, or not all of the mixture is fitted yet. `prepared`: what the slot holds.
bool passes_mixture_build(const filter_context *context, uint32_t material,
                          const mixture_kind *kind, const void *prepared, moment_map *mixture);

#endif
