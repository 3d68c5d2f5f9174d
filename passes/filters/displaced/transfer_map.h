#ifndef PASSES_FILTERS_DISPLACED_TRANSFER_MAP_H
#define PASSES_FILTERS_DISPLACED_TRANSFER_MAP_H

#include "passes/context/filter.h"
#include "passes/filters/displaced/relief.h"
#include "passes/maps/kept/kept_file.h"
#include "passes/maps/level_reduction.h"

/// How the light of a relief is found.
typedef struct transfer_kind {
    uint32_t order;    ///< functions of direct light [4, TRANSFER_MAXIMUM_ORDER]
    uint32_t azimuths; ///< of a facet's horizon [4, 64]
    uint32_t bounces;  ///< between facets, at least 1
    lobe_format format;
    bool normals;  ///< facets' normals are read, for what they mirror
    bool coloured; ///< the diffuse colour varies over the relief
} transfer_kind;

/// The transfer of light by a relief, of each cell, see shaders/interface/displacement/relief.h.
typedef struct transfer_map {
    reduced_map map;
    reduced_map facets;    ///< the facets' normals, if asked for
    lobe_resource closure; ///< struct transfer_closure_constants
} transfer_map;

/// Whether a map lies on the surface as the material's heights do, and repeats as they do.
bool passes_lies_on_relief(const lobe_material *material, const lobe_texture_use *use);
/// Whether a material's diffuse colour varies over its relief in such a way that colours can be
/// found by place: the map of colours, and that of metal, lie on the surface as the heights do.
bool passes_has_coloured_relief(const device_material *material);

/// Whether buffers can hold the facets of a material's relief.
bool passes_transfer_fits(const device_material *material, const transfer_kind *kind);

/// What the map, and that of facets, take; returns how many of the two there are.
uint32_t passes_transfer_images(const device_material *material, const transfer_kind *kind,
                                kept_image images[2]);

/// The parts of the work: bands of facet_transfer, bands of facet_links, then all the rest.
uint32_t passes_transfer_part_count(const device_material *material, const transfer_kind *kind);

/// Adds the passes that make it for a material with a relief: basis_cells, transfer_basis,
/// facet_transfer, facet_links, facet_colours, facet_bounces, cell_transfer, facet_normals,
/// level_reduction and transfer_closure. They run when the height map or its scale changes; when
/// colours do only if `coloured`, and then without facet_transfer and facet_links. A map whose
/// facets a buffer cannot hold fails the frame.
/// `parts`: those that are added, from the first on; UINT32_MAX: all. Without the last one, the map
/// has no content. `in_parts`: what later parts need is kept between frames, about 40 bytes a
/// facet.
/// `relief`: retained if `in_parts`.
transfer_map passes_transfer_map(const filter_context *context, uint32_t material,
                                 const transfer_kind *kind, const relief *relief, uint32_t parts,
                                 bool in_parts);

/// Declares the maps alone.
transfer_map passes_transfer_map_declare(const filter_context *context, uint32_t material,
                                         const transfer_kind *kind);

#endif
