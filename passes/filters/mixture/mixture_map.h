#ifndef PASSES_FILTERS_MIXTURE_MIXTURE_MAP_H
#define PASSES_FILTERS_MIXTURE_MIXTURE_MAP_H

#include "passes/maps/kept/kept_file.h"
#include "passes/maps/moment_map.h"

/// What is fitted to each texel.
typedef struct mixture_kind {
    uint32_t components; ///< Gaussians a texel [1, MIXTURE_MAXIMUM_COMPONENTS]
    uint32_t steps;      ///< of expectation maximisation in each level
    uint32_t plane;      ///< MIXTURE_PLANE_...; decides the map's layers, too
    uint32_t start;      ///< MIXTURE_START_...
    uint32_t own_steps;  ///< MIXTURE_START_CLOSEST: from a texel's own start; else 0
    float least_gain;    ///< the same: what that must gain, in parts of the squared lobes
    float prior;         ///< samples that a neighbour's component is worth, times its part
    uint32_t shape;      ///< MIXTURE_SHAPE_...
    bool is_printed;     ///< formulas are those that Tan et al. print
    bool own_colours;    ///< each has its own specular colour
    lobe_format format;
} mixture_kind;

/// What a map of mixtures takes.
kept_image passes_mixture_extent(const device_material *material, const mixture_kind *kind);

/// Adds the passes that fit a mixture of Gaussians to the lobes under each texel of each level,
/// from the coarsest level to the finest: mixture_samples, mixture_root, mixture_fit for levels of
/// large texels, mixture_search for quarters of the map, mixture_level, mixture_gather. The
/// material has a normal or a width map. They run when these change, and take far longer than
/// moment_binning. Result: a map as of moments, with a bin for each component.
///
/// Tan et al. 2005, Multiresolution Reflectance Filtering; differs from it in the start, see
/// docs/mixtures.md.
moment_map passes_mixture_map(const filter_context *context, uint32_t material,
                              const mixture_kind *kind);

/// The parts of that work: the root with the samples, then each level from the coarsest on, large
/// ones in bands of rows.
uint32_t passes_mixture_part_count(const device_material *material, const mixture_kind *kind);

/// The same in several frames: adds the passes of the first `parts` parts only. What later parts
/// need is kept between frames, 32 bytes for each texel of the maps and base lobe.
moment_map passes_mixture_map_parts(const filter_context *context, uint32_t material,
                                    const mixture_kind *kind, uint32_t parts);

/// Declares the map alone, which has content if an earlier frame made it.
moment_map passes_mixture_map_declare(const filter_context *context, uint32_t material,
                                      const mixture_kind *kind);

#endif
