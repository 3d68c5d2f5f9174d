#ifndef PASSES_FILTERS_MOMENTS_CORESET_H
#define PASSES_FILTERS_MOMENTS_CORESET_H

#include <stdint.h>

/// A weighted sample of the texels of a map whose size need not be known beforehand: texels are
/// drawn with a probability proportional to a density, and stand for the inverse of it. With a
/// density that grows with the squared distance from the mean, the sample also serves what is rare
/// and far from the rest (Bachem, Lucic, Krause 2018, Scalable k-Means Clustering via Lightweight
/// Coresets). Stratified: the integral of the density is cut into equal parts, of which each gives
/// a texel at a place that is hashed from the part's number.

enum { CORESET_TEXELS = 1024 };

typedef struct coreset_texel {
    uint32_t x, y;
    float weight;
} coreset_texel;

typedef struct coreset {
    double part;      ///< the density's integral over a part
    double sum, next; ///< integral so far, and where the next texel is drawn
    uint32_t count;   ///< of texels: parts that have been drawn from
    coreset_texel texels[CORESET_TEXELS];
} coreset;

/// `total`: about the integral over all texels; if it is more, parts are merged. `least`: the
/// smallest density; of a small map every texel is drawn.
void passes_coreset_begin(coreset *set, double total, double least);
/// Adds row `y` of `width` texels, with the density of each (above 0).
void passes_coreset_add_row(coreset *set, const float *density, uint32_t width, uint32_t y);

#endif
