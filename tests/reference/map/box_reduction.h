#ifndef TESTS_REFERENCE_MAP_BOX_REDUCTION_H
#define TESTS_REFERENCE_MAP_BOX_REDUCTION_H

#include "tests/reference/mixture/layers.h"

/// Part of target texel `j` that lies over source texel `i` of a row of `size` texels halved to
/// max(1, floor(size / 2)): its weight in the mean.
double reference_box_weight(uint32_t i, uint32_t size, uint32_t j);

/// The next MIP level: each dimension of n texels becomes max(1, floor(n / 2)), each target texel
/// the mean of the source under its own area. The caller frees the result.
reference_layers reference_reduce(const reference_layers *source);

/// The mean of each layer over the whole image, straight from its texels: what every chain of
/// reductions must end at. `means` has four doubles a layer.
void reference_mean(const reference_layers *source, double *means);

#endif
