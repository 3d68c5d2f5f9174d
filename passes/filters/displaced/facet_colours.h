#ifndef PASSES_FILTERS_DISPLACED_FACET_COLOURS_H
#define PASSES_FILTERS_DISPLACED_FACET_COLOURS_H

#include "passes/context/filter.h"
#include "passes/filters/displaced/window.h"

/// The colours of a relief's facets, where they vary.

/// Whether a map of a material with heights, if it has that, lies on the surface as the heights do,
/// and repeats as they do.
bool passes_lies_on_relief(const device_material *material, uint32_t map);
/// Whether a material's diffuse colour varies over its relief in such a way that colours can be
/// found by place: the map of colours, and that of metal, lie on the surface as the heights do.
bool passes_has_coloured_relief(const device_material *material);
/// Whether microfacets' roughness varies over its relief in such a way.
bool passes_has_widths_on_relief(const device_material *material);
/// Whether a material's relief shines: evenly, or by a map that lies on the surface in such a way.
bool passes_has_emissive_relief(const device_material *material);

/// Adds facet_colours: TRANSFER_COLOUR_WORDS for each facet of a window.
lobe_resource passes_facet_colours(const filter_context *context, uint32_t material,
                                   const relief *relief, const facet_window *window);

#endif
