#ifndef TESTS_PASSES_FILTERS_WU_RELIEF_TRUTH_H
#define TESTS_PASSES_FILTERS_WU_RELIEF_TRUTH_H

#include <lobe/image.h>

/// What the cells of a relief reflect, by paths of light that are followed in double precision, in
/// a way of its own: a ray is below the relief somewhere if it is so where it crosses a side of a
/// facet.

enum { TRUTH_DIRECTIONS = 48 };

/// Unit, in the relief's frame (shaders/interface/displacement/relief.h), with the density of the
/// cosine up to 82 degrees, none of them in the filters' tables.
void relief_truth_directions(double directions[TRUTH_DIRECTIONS][3]);

typedef struct relief_truth {
    uint32_t cells; ///< of the map
    /// By cell, direction of the light and of the viewer: radiance times the area that the viewer
    /// sees, over the cell's, for irradiance 1 on a plane that faces the light. Twice: two
    /// independent halves of the points.
    double *light[2];
    double *visible; ///< by cell and viewer: that area; of the flat carrier, the cosine
} relief_truth;

/// Of an RGBA32_FLOAT map with heights in texels' widths in red; cells of `texels` x `texels`, each
/// by 2 x `points` points. `bounces`: facets of a path at most. Free with relief_truth_free.
relief_truth relief_truth_of(const lobe_image *map, uint32_t texels, double albedo,
                             uint32_t bounces, uint32_t points);
void relief_truth_free(relief_truth *truth);

#endif
