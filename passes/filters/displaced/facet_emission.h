#ifndef PASSES_FILTERS_DISPLACED_FACET_EMISSION_H
#define PASSES_FILTERS_DISPLACED_FACET_EMISSION_H

#include "passes/filters/displaced/cells_source.h"

/// The light that a relief's facets send out because they shine, and that they reflect of each
/// other's: four floats a facet, of which the last is 0.
typedef struct facet_emission {
    lobe_resource emitted;
    lobe_resource sent; ///< with what is reflected
} facet_emission;

/// Adds facet_emission, once and then for each of the kind's steps between facets, for a window.
/// `colours`: of its facets, see passes_facet_colours.
facet_emission passes_facet_emission(const cells_source *source, lobe_resource colours);

#endif
