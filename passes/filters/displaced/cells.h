#ifndef PASSES_FILTERS_DISPLACED_CELLS_H
#define PASSES_FILTERS_DISPLACED_CELLS_H

#include "passes/filters/displaced/cells_source.h"
#include "passes/maps/level_reduction.h"

/// The texels of level 0 that a window makes of what its facets see: light between facets, and
/// means over those under each texel.

/// Where they go: of maps that begin at this texel of those of the whole relief.
typedef struct cells_target {
    reduced_map *transfer;
    reduced_map *facets; ///< the facets' normals, if the kind has them
    uint32_t column, row;
} cells_target;

/// The passes that write them: layers do not depend on each other.
typedef struct cell_passes {
    lobe_pass *passes[5];
    uint32_t count;
} cell_passes;

/// Layers of the map of transfer, and of that of facets' normals.
uint32_t passes_transfer_layers(const transfer_kind *kind);
uint32_t passes_facet_layers(const transfer_kind *kind);

/// Adds facet_colours, facet_bounces, cell_transfer, facet_emission, cell_emission and
/// facet_normals, as far as the kind needs them.
cell_passes passes_cells_add(const cells_source *source, const cells_target *target);

#endif
