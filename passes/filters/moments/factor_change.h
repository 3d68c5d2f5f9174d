#ifndef PASSES_FILTERS_MOMENTS_FACTOR_CHANGE_H
#define PASSES_FILTERS_MOMENTS_FACTOR_CHANGE_H

#include "shaders/interface/material.h"

/// What a change of a material's numbers, with the same maps, means for bins that were made before.
typedef enum factor_change {
    FACTORS_KEEP_LOBES, ///< all lobes are as they were
    FACTORS_MOVE_LOBES, ///< so little that as many bins serve them, once these are fitted again
    FACTORS_REPLACE_LOBES,
} factor_change;

factor_change passes_factor_change(const struct material_constants *before,
                                   const struct material_constants *after);

#endif
