#ifndef PASSES_FILTERS_DISPLACED_KEPT_TRANSFER_H
#define PASSES_FILTERS_DISPLACED_KEPT_TRANSFER_H

#include "passes/filters/displaced/transfer_map.h"

/// Transfer of light that is kept from frame to frame, made in parts and found in a cache folder:
/// see passes/maps/kept/record.h, whose functions `forget` and `save` serve.

/// For lobe_filter.prepare.
lobe_result passes_kept_transfer_prepare(const filter_context *context, uint32_t material,
                                         const transfer_kind *kind, void **slot);

/// Adds the passes that make the transfer of a material with a relief, or those that restore it.
/// false: not all of it is made yet. `prepared`: what the slot holds. `relief`: what it is made
/// from; passes of every frame read it if `near`.
bool passes_kept_transfer_build(const filter_context *context, uint32_t material,
                                const transfer_kind *kind, const void *prepared, bool near,
                                transfer_map *transfer, relief *relief);

#endif
