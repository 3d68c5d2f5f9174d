#ifndef PASSES_FILTERS_DISPLACED_TRANSFER_MAP_H
#define PASSES_FILTERS_DISPLACED_TRANSFER_MAP_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"

/// How the light of a relief is found.
typedef struct transfer_kind {
    uint32_t order;    ///< functions of direct light: 4 or 9
    uint32_t azimuths; ///< of a facet's horizon [4, 64]
    uint32_t bounces;  ///< between facets, at least 1
    lobe_format format;
    bool normals; ///< facets' normals are read, for what they mirror
} transfer_kind;

/// The transfer of light by a relief, of each cell, see shaders/interface/displacement/relief.h.
typedef struct transfer_map {
    reduced_map map;
    reduced_map facets;    ///< the facets' normals, if asked for
    lobe_resource closure; ///< struct transfer_closure_constants
} transfer_map;

/// Adds the passes that make it for a material with a relief: those of the relief, facet_transfer,
/// facet_links, facet_bounces, cell_transfer, facet_normals, level_reduction and transfer_closure.
/// They run when the height map or its scale changes, not when colours do. A map whose facets a
/// buffer cannot hold fails the frame.
transfer_map passes_transfer_map(const filter_context *context, uint32_t material,
                                 const transfer_kind *kind);

#endif
