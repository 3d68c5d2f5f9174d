#ifndef PASSES_FILTERS_LOBES_SUBDIVISION_CHOICE_H
#define PASSES_FILTERS_LOBES_SUBDIVISION_CHOICE_H

#include "passes/upload/device_scene.h"

/// How mixtures are made and drawn.
typedef struct subdivision_request {
    uint32_t clusters;                ///< CLUSTERS_... of shaders/interface/cluster.h
    uint32_t widths;                  ///< of how many widths each mixture's lobes are, 1 or 2
    uint32_t threshold;               ///< THRESHOLD_... of shaders/interface/mixture.h
    double epsilon0, epsilon1, blend; ///< as in struct lobes_knobs
} subdivision_request;

/// The smallest subdivision [0, 2] whose mixtures, in tangent space, are about as close to the
/// material's lobes as those of the best one. Decided from a few patches of its maps: the ground
/// truth is the mean of all lobes of a patch that a mask keeps, the candidates are its mixtures of
/// one, four and eight as shading draws them.
uint32_t passes_subdivision_choose(const device_scene *scene, const device_material *material,
                                   const subdivision_request *request);

#endif
