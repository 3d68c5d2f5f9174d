#ifndef PASSES_FILTERS_MOMENTS_LOBE_COLUMNS_H
#define PASSES_FILTERS_MOMENTS_LOBE_COLUMNS_H

#include "passes/filters/moments/survey.h"

/// Samples of lobes by columns, in single precision: compilers vectorise sums over them, which take
/// a third to a fifth of the time of those over plane_sample.
typedef struct lobe_columns {
    uint32_t count; ///< with some of no weight, which fill the last block
    float place[2][SURVEY_TEXELS * LOBE_MATERIAL_MAXIMUM_LOBES];
    float variance[SURVEY_TEXELS * LOBE_MATERIAL_MAXIMUM_LOBES];
    float weight[SURVEY_TEXELS * LOBE_MATERIAL_MAXIMUM_LOBES]; ///< in all 1
} lobe_columns;

void passes_lobe_columns_fill(const plane_sample *samples, uint32_t count, lobe_columns *columns);

/// The logarithm of a lobe's chance: with the distance d from `mean` and the variance v,
/// offset - d^T A d - v trace A.
typedef struct lobe_chance {
    float mean[2], offset;
    float squares[3]; ///< A: xx, yy, xy
} lobe_chance;

/// Shares all lobes out to `count` components [1, MOMENT_MAXIMUM_BINS], and sums what each has of
/// them, with places from its mean. Returns the mean logarithm of the sum of chances.
double passes_lobe_columns_share(const lobe_columns *columns, const lobe_chance *chances,
                                 uint32_t count, plane_sums *sums);

#endif
