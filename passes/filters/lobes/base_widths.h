#ifndef PASSES_FILTERS_LOBES_BASE_WIDTHS_H
#define PASSES_FILTERS_LOBES_BASE_WIDTHS_H

#include "passes/maps/material_patch.h"

enum { MAXIMUM_WIDTHS = 2 };

/// Base lobes that stand for those of a patch, as in shaders/lib/lobe/width_pair.glsl, where u is
/// defined. The sharper comes first.
typedef struct base_widths {
    uint32_t count;
    double complements[MAXIMUM_WIDTHS]; ///< 1 - |r|
    double parts[MAXIMUM_WIDTHS];       ///< add up to 1
    double mean;                        ///< of all in the patch: of u
    double distance;                    ///< of both in u; of one, 0
} base_widths;

/// 1 - |r| of a lobe, and u.
double passes_lobe_complement(const material_lobe *lobe);
double passes_lobe_width(const material_lobe *lobe);

/// `count`: 1 or 2; one where all are of one width. The patch has lobes.
base_widths passes_base_widths(const material_patch *source, uint32_t count);

#endif
