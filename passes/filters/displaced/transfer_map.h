#ifndef PASSES_FILTERS_DISPLACED_TRANSFER_MAP_H
#define PASSES_FILTERS_DISPLACED_TRANSFER_MAP_H

#include "passes/context/filter.h"
#include "passes/filters/displaced/facets.h"
#include "passes/maps/kept/kept_file.h"
#include "passes/maps/level_reduction.h"

/// The transfer of light by a relief, of each cell, see shaders/interface/displacement/relief.h.
typedef struct transfer_map {
    reduced_map map;
    reduced_map facets;    ///< the facets' normals, if asked for
    lobe_resource closure; ///< struct transfer_closure_constants
} transfer_map;

/// Whether a map of a material with heights, if it has that, lies on the surface as the heights do,
/// and repeats as they do.
bool passes_lies_on_relief(const device_material *material, uint32_t map);
/// Whether a material's diffuse colour varies over its relief in such a way that colours can be
/// found by place: the map of colours, and that of metal, lie on the surface as the heights do.
bool passes_has_coloured_relief(const device_material *material);

/// What the map, and that of facets, take; returns how many of the two there are.
uint32_t passes_transfer_images(const device_material *material, const transfer_kind *kind,
                                kept_image images[2]);

/// The most facets that buffers hold at a time.
uint64_t passes_transfer_facets(const transfer_kind *kind);
/// Whether they hold all of the material's relief, which is then made in one window.
bool passes_transfer_is_whole(const device_material *material, const transfer_kind *kind);

/// The parts of the work, window by window: bands of facet_transfer, bands of facet_links, then its
/// part of the map, and all the rest with the last one.
uint32_t passes_transfer_part_count(const device_material *material, const transfer_kind *kind);

/// Adds the passes that make it for a material with a relief: those of passes_facets,
/// facet_colours, facet_bounces, cell_transfer, facet_normals, level_reduction and
/// transfer_closure. They run when the height map or its scale changes; when colours do only if
/// `coloured`, and then without facet_transfer and facet_links of a relief that is made in one
/// window.
/// `parts`: those that are added, from the first on; UINT32_MAX: all. Without the last one, the map
/// has no content. `in_parts`: what later parts need is kept between frames, see passes_facets.
/// `seen`: what all facets see, if that was found elsewhere; NULL: it is found here.
/// `relief`: retained if `in_parts`.
transfer_map passes_transfer_map(const filter_context *context, uint32_t material,
                                 const transfer_kind *kind, const relief *relief,
                                 const seen_facets *seen, uint32_t parts, bool in_parts);

/// Declares the maps alone.
transfer_map passes_transfer_map_declare(const filter_context *context, uint32_t material,
                                         const transfer_kind *kind);

#endif
