#ifndef PASSES_FILTERS_MOMENTS_CELL_SURVEY_H
#define PASSES_FILTERS_MOMENTS_CELL_SURVEY_H

#include "passes/context/filter.h"

/// What the device finds of a material's lobes, as passes_lobe_survey_make does on the host:
/// retained buffers, see shaders/interface/moment_refit.h.
typedef struct cell_survey {
    lobe_resource extremes, lobes;
    uint32_t cells, lobe_count; ///< lengths of the two
} cell_survey;

/// Declares the buffers for a material that has a normal or a width map.
cell_survey passes_moment_cell_survey_declare(const filter_context *context, uint32_t material);

/// Adds the pass that surveys the material's lobes. It runs when texels change. `bright_texels`: it
/// also finds the largest texel of the colour maps. `part`: of each cell it reads at most so many
/// texels along each axis [1, SURVEY_PART]; 0: all.
void passes_moment_cell_survey(const filter_context *context, uint32_t material, bool bright_texels,
                               uint32_t part, cell_survey *survey);

#endif
