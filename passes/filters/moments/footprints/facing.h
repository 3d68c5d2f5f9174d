#ifndef PASSES_FILTERS_MOMENTS_FOOTPRINTS_FACING_H
#define PASSES_FILTERS_MOMENTS_FOOTPRINTS_FACING_H

#include "passes/filters/moments/plane_sample.h"

/// What low viewers see of Lambert's part: facets that face away are black, and a bin knows of
/// those only what a Gaussian of their normals does.

enum { FACING_VIEWERS = 8 };

/// The mean of max(0, <n, o>) over normals, for viewers all around, each lit from where it stands.
typedef struct facing_light {
    double seen[FACING_VIEWERS];
} facing_light;

/// Adds normals of a sample; `weight`: their part of the footprint.
void passes_facing_add_sample(facing_light *light, const plane_sample *sample, double weight);
/// Adds those of a bin, which are Gaussian in the plane; `weight` as above.
void passes_facing_add_bin(facing_light *light, const plane_sums *sums, double weight);
/// The squared difference, over the square of `truth`.
double passes_facing_error(const facing_light *light, const facing_light *truth);

#endif
