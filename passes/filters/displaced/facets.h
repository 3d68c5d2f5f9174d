#ifndef PASSES_FILTERS_DISPLACED_FACETS_H
#define PASSES_FILTERS_DISPLACED_FACETS_H

#include "passes/filters/displaced/window.h"

/// What the facets of a relief see, each by itself, see shaders/interface/displacement/relief.h.
/// That is most of the work, and some of the facets may be left to other processes.

/// Consecutive facets; the first is a multiple of two groups of threads.
typedef struct facet_range {
    uint32_t first, count;
} facet_range;

/// Those of a share, counted from 1 on. The last shares of small reliefs may be empty.
facet_range passes_facets_share(const device_map *heights, uint32_t share, uint32_t shares);

typedef struct seen_facets {
    lobe_resource basis; ///< struct transfer_basis_constants
    lobe_resource words; ///< b of each facet of the range
    lobe_resource links;
} seen_facets;

/// Bytes of words, links and basis.
void passes_facets_bytes(facet_range range, const transfer_kind *kind, uint32_t bytes[3]);

/// The parts of the work: bands of facet_transfer, then bands of facet_links.
uint32_t passes_facets_part_count(facet_range range, const transfer_kind *kind);

/// What is to be seen.
typedef struct facets_request {
    lobe_graph *graph;
    uint32_t material;
    const relief *relief;
    const transfer_kind *kind;
    lobe_resource basis; ///< that was found elsewhere; all zero: it is found here
    /// What the passes make is kept between frames, about 40 bytes a facet. It also is where
    /// colours vary or facets shine, of the last window.
    bool in_parts;
} facets_request;

/// Declares the buffers for up to so many facets, and adds basis_cells, transfer_basis and
/// facet_groups where they are needed.
seen_facets passes_facets_begin(const facets_request *request, uint32_t facets);

/// Adds facet_transfer and facet_links for a range of a window's facets, in place of what the
/// buffers had. `most`: parts that are added, from the first on. `keeps`: the last one is made,
/// although nothing reads it in this frame. Returns the number of parts.
uint32_t passes_facets_add(const facets_request *request, const facet_window *window,
                           facet_range range, uint32_t most, bool keeps, seen_facets *seen);

#endif
