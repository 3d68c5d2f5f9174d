#ifndef PASSES_ENVIRONMENT_STANDALONE_MAPS_H
#define PASSES_ENVIRONMENT_STANDALONE_MAPS_H

#include <lobe/environment_maps.h>

#include "passes/environment/maps.h"

/// Begins a frame of the graph that holds the maps of lobe/environment_maps.h, for passes that read
/// them.
lobe_graph *passes_standalone_maps_begin(lobe_environment_maps *maps, environment_maps *cubes);

#endif
