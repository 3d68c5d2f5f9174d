#ifndef PASSES_FILTERS_MIXTURE_RECORD_H
#define PASSES_FILTERS_MIXTURE_RECORD_H

#include "passes/filters/mixture/mixture_map.h"

/// Mixtures that are kept from frame to frame, made in parts and found in a cache folder: see
/// passes/maps/kept/record.h, whose functions `forget` and `save` serve.

/// For lobe_filter.prepare.
lobe_result passes_mixture_prepare(const filter_context *context, uint32_t material,
                                   const mixture_kind *kind, void **slot);

/// Adds the passes that fit the mixture, or those that restore it. false: the material's lobes do
/// not vary, or not all of the mixture is fitted yet. `prepared`: what the slot holds.
bool passes_mixture_build(const filter_context *context, uint32_t material,
                          const mixture_kind *kind, const void *prepared, moment_map *mixture);

#endif
