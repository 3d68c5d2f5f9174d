#ifndef PASSES_FILTERS_WU_KEPT_MODELS_H
#define PASSES_FILTERS_WU_KEPT_MODELS_H

#include "passes/filters/wu/models.h"

/// Models of reliefs that are kept from frame to frame, made in parts and found in a cache folder:
/// see passes/maps/kept/record.h, whose functions `forget` and `save` serve.

/// For lobe_filter.prepare.
lobe_result passes_kept_models_prepare(const filter_context *context, uint32_t material,
                                       const wu_kind *kind, void **slot);

/// Adds the passes that make the models of a material with a relief, or takes those of a file.
/// false: not all of them are made yet. `prepared`: what the slot holds.
bool passes_kept_models_build(const filter_context *context, uint32_t material, const wu_kind *kind,
                              const void *prepared, wu_models *models);

#endif
