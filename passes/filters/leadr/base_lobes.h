#ifndef PASSES_FILTERS_LEADR_BASE_LOBES_H
#define PASSES_FILTERS_LEADR_BASE_LOBES_H

#include "passes/context/filter.h"

/// Adds the pass that makes a map of the base lobes of a material's microfacets
/// (shaders/filters/leadr/base_lobes.comp) where their roughness or metal varies, and binds it; for
/// others, and where it is not needed, it costs nothing. Called after passes_lobe_map_bind, to
/// whose bytes it adds its own.
void passes_base_lobes_build(const filter_context *context, uint32_t material, bool needed,
                             filtered_appearance *appearance);

#endif
