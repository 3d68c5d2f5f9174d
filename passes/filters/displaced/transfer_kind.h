#ifndef PASSES_FILTERS_DISPLACED_TRANSFER_KIND_H
#define PASSES_FILTERS_DISPLACED_TRANSFER_KIND_H

#include "passes/filters/displaced/relief.h"

/// How the light of a relief is found.
typedef struct transfer_kind {
    uint32_t order;    ///< functions of direct light [4, TRANSFER_MAXIMUM_ORDER]
    uint32_t azimuths; ///< of a facet's horizon [4, 64]
    uint32_t bounces;  ///< between facets, at least 1
    lobe_format format;
    bool normals;         ///< facets' normals are read, for what they mirror
    bool coloured;        ///< the diffuse colour varies over the relief
    bool emissive;        ///< facets shine
    bool widths;          ///< microfacets' roughness does, which is kept beside normals
    uint64_t most_facets; ///< that buffers hold at a time; 0: as many as they can
} transfer_kind;

/// The push constants of the passes that find it, for a window that is all of the relief.
struct transfer_constants passes_transfer_constants(const relief *relief,
                                                    const transfer_kind *kind);

enum { KIND_CONSTANTS = 4 };

/// The map's number of functions, whether its colours and widths vary, and whether it shines, as
/// constants of a shader.
typedef struct kind_specialisation {
    lobe_specialisation items[KIND_CONSTANTS];
} kind_specialisation;

kind_specialisation passes_transfer_specialisation(const transfer_kind *kind);

#endif
