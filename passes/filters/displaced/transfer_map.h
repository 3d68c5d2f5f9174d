#ifndef PASSES_FILTERS_DISPLACED_TRANSFER_MAP_H
#define PASSES_FILTERS_DISPLACED_TRANSFER_MAP_H

#include "passes/context/filter.h"
#include "passes/filters/displaced/facets.h"
#include "passes/maps/kept/record.h"
#include "passes/maps/level_reduction.h"

/// The transfer of light by a relief, of each cell, see shaders/interface/displacement/relief.h.
typedef struct transfer_map {
    reduced_map map;
    reduced_map facets;    ///< the facets' normals, if asked for
    lobe_resource closure; ///< struct transfer_closure_constants
} transfer_map;

/// The most facets that buffers hold at a time.
uint64_t passes_transfer_facets(const transfer_kind *kind);
/// The windows that it is made in, one after the other. What each of them makes of the map is a
/// tile of it.
window_grid passes_transfer_grid(const device_material *material, const transfer_kind *kind);
/// Whether one holds all of the relief.
bool passes_transfer_is_whole(const device_material *material, const transfer_kind *kind);

/// What a file has of a window's tile, and the parts of its work: bands of facet_transfer, bands of
/// facet_links, then the tile, and all the rest with the last one.
kept_tile passes_transfer_tile(const device_material *material, const transfer_kind *kind,
                               uint32_t window);

/// Device memory of the map, and of a window's facets.
uint64_t passes_transfer_bytes(const device_material *material, const transfer_kind *kind);
uint64_t passes_transfer_making_bytes(const device_material *material, const transfer_kind *kind);

/// A map that is asked for.
typedef struct transfer_request {
    const filter_context *context;
    uint32_t material;
    const transfer_kind *kind;
    const relief *relief; ///< retained if `in_parts`; read unless all tiles are stored
    /// What all facets see, if that was found elsewhere; NULL: it is found here.
    const seen_facets *seen;
    /// Which tiles are stored, and which are to be saved; NULL: none.
    const kept_record *record;
    uint32_t parts; ///< that are added, from the first on; UINT32_MAX: all
    bool in_parts;  ///< what later parts need is kept between frames, see passes_facets
} transfer_request;

/// Declares a map, with what earlier frames have left in it.
transfer_map passes_transfer_declare(const filter_context *context, uint32_t material,
                                     const transfer_kind *kind);
/// Whether all of it can be read before this frame writes it.
bool passes_transfer_has_content(const lobe_graph *graph, const transfer_kind *kind,
                                 const transfer_map *map);

/// Adds the passes that make it for a material with a relief: those of passes_facets,
/// passes_cells_add, level_reduction and transfer_closure. They run when the height map or its
/// scale changes; when colours do only if the kind is coloured, and then without facet_transfer and
/// facet_links of a relief that is made in one window. Without the last part, the map has no
/// content.
void passes_transfer_map(const transfer_request *request, transfer_map *map);

/// Adds the passes that make tiles one after the other, as far as parts go, without the map: those
/// of the windows from `first` on, each `step`-th, which are to be saved.
void passes_transfer_tiles(const transfer_request *request, uint32_t first, uint32_t step);

#endif
