#ifndef PASSES_FILTERS_DISPLACED_CELLS_SOURCE_H
#define PASSES_FILTERS_DISPLACED_CELLS_SOURCE_H

#include "passes/context/filter.h"
#include "passes/filters/displaced/facets.h"

/// What the texels of level 0 that a window makes (passes_cells_add), and the light between its
/// facets, are made of.
typedef struct cells_source {
    const filter_context *context;
    uint32_t material;
    const transfer_kind *kind;
    const relief *relief;
    const seen_facets *seen; ///< of the window
    const facet_window *window;
} cells_source;

#endif
