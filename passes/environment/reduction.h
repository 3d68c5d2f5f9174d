#ifndef PASSES_ENVIRONMENT_REDUCTION_H
#define PASSES_ENVIRONMENT_REDUCTION_H

#include "passes/maps/level_reduction.h"

/// Adds the passes that compute levels 1 and up of an environment's cube (six layers) from its
/// level 0: means weighted by solid angle, so that every level has the same energy. The width is a
/// power of two.
void passes_environment_reduction(lobe_graph *graph, reduced_map *cube);

#endif
