#ifndef TOOLS_COMPARE_SILHOUETTES_H
#define TOOLS_COMPARE_SILHOUETTES_H

#include <stdbool.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// Pixels along silhouettes: there the error of a filter is that of coverage, not of appearance.

/// Which pixels errors are measured over.
typedef enum compare_part {
    COMPARE_PART_ALL,
    COMPARE_PART_INSIDE,      ///< what is neither along a silhouette nor background
    COMPARE_PART_SILHOUETTES, ///< along silhouettes
    COMPARE_PART_COUNT
} compare_part;

/// Finds a part's pixels. `depth` is RGBA32_FLOAT; its R is the depth along the view, 0 where only
/// background is seen. A pixel lies along a silhouette if in it, or in one of the eight around it,
/// the inverse depth bends by more than SILHOUETTE_BEND: a plane's is linear in the picture, so
/// that it never bends, however flat it is seen. `pixels` is row by row; the caller frees it with
/// free. It is NULL for COMPARE_PART_ALL. Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result silhouettes_find_part(const lobe_image *depth, compare_part part, const lobe_host *host,
                                  bool **pixels);

/// Of the second difference of the inverse depth between neighbours, relative to the largest of the
/// three inverse depths.
#define SILHOUETTE_BEND 0.05

#endif
