#ifndef PASSES_FILTERS_LOBES_SUBDIVISION_CHOICE_H
#define PASSES_FILTERS_LOBES_SUBDIVISION_CHOICE_H

#include "passes/upload/device_scene.h"

/// The smallest subdivision [0, 2] whose mixtures, in tangent space, are about as close to the
/// material's lobes as those of the best one. Decided from a few patches of its maps: the ground
/// truth is the mean of all lobes of a patch that a mask keeps, the candidates are its mixtures of
/// one, four and eight. `clusters`: CLUSTERS_... of shaders/interface/cluster.h. `tolerance`: how
/// many times the smallest error is good enough, at least 1. `widths`: of how many widths each
/// mixture's lobes are, 1 or 2.
uint32_t passes_subdivision_choose(const device_scene *scene, const device_material *material,
                                   uint32_t clusters, uint32_t widths, double tolerance);

#endif
