#ifndef PASSES_FILTERS_MOMENTS_PARTITION_H
#define PASSES_FILTERS_MOMENTS_PARTITION_H

#include <stdbool.h>
#include <stdint.h>

#include "passes/filters/moments/bin_choice.h"
#include "passes/upload/device_scene.h"
#include "shaders/interface/moment_bins.h"

/// How a material's lobes are distributed over bins, and the ranges of the bins' moments (all but
/// those of colours), so that 16 bits hold them precisely: decided once, on the host, from the
/// material's maps. For other texels of these, or if the host cannot read them, moments/refit.h
/// makes the constants.
///
/// A fitted partition is a mixture of Gaussians for the whole material, from expectation
/// maximisation over some thousand of its lobes. Each lobe counts as several points; their number
/// is the one that best separates sharp from rough lobes (Vasconcelos, Lippman 1998). Partitions by
/// hats have one bin for rough lobes and four, or five with a cap, for directions.
typedef struct moment_partition {
    uint32_t kind;          ///< PARTITION_...
    uint32_t bins;          ///< [1, MOMENT_MAXIMUM_BINS]
    bool own_colours;       ///< bins have specular colours of their own
    bool many_points;       ///< texels of the base maps are read at as many points as under a mask
    uint32_t width, height; ///< of the base maps, texels: the larger of normal and width map
    float points;           ///< that a lobe counts as
    bool has_first;         ///< false: the host could not read the maps, and has fitted nothing
    struct moment_binning_constants constants;
} moment_partition;

typedef struct partition_request {
    uint32_t kind;    ///< PARTITION_...
    bin_request bins; ///< of a fitted partition; partitions by hats have a fixed number
} partition_request;

/// Partitions the lobes of a material that has a normal or a width map. Errors:
/// LOBE_ERROR_OUT_OF_MEMORY, not logged.
lobe_result passes_moment_partition_make(const device_scene *scene, uint32_t material,
                                         const partition_request *request, const lobe_host *host,
                                         moment_partition *partition);

#endif
