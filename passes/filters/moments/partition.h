#ifndef PASSES_FILTERS_MOMENTS_PARTITION_H
#define PASSES_FILTERS_MOMENTS_PARTITION_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/scene.h>

#include "shaders/interface/moment_bins.h"

/// How a material's lobes are shared out to bins, decided once from its maps on the host, and the
/// range of its lobes in the Lambert plane (`constants.range`, without that of colours), so that
/// moments keep their digits in 16 bits.
///
/// A fitted partition is a mixture of Gaussians for the whole material, by expectation and
/// maximisation over some thousand of its lobes, each taken for as many points as make the sharp
/// and the rough part ways (Vasconcelos, Lippman 1998). Partitions by hats have one bin for what is
/// rough and four, or five with a cap, for directions.
typedef struct moment_partition {
    uint32_t kind;          ///< PARTITION_...
    uint32_t bins;          ///< [1, MOMENT_MAXIMUM_BINS]
    uint32_t width, height; ///< of the base maps, texels: the larger of normal and width map
    struct moment_binning_constants constants;
} moment_partition;

/// The partition that was asked for last.
typedef struct moment_partition_cache {
    bool filled;
    uint32_t kind, bins; ///< as asked for
    moment_partition partition;
} moment_partition_cache;

struct device_scene;

/// The partition of a material that has a normal or width map: fitted, of as many bins as are asked
/// for [1, MOMENT_MAXIMUM_BINS], or 0: the least number that serves some patches of the maps about
/// as well as the best number does; or by hats, which have a number of their own. Kept with the
/// scene until another is asked for. NULL without memory.
const moment_partition *passes_moment_partition_of(const struct device_scene *scene,
                                                   uint32_t material, uint32_t kind, uint32_t bins);

#endif
