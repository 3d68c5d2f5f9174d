#ifndef PASSES_ENVIRONMENT_CUBE_H
#define PASSES_ENVIRONMENT_CUBE_H

#include <lobe/environment.h>
#include <lobe/graph.h>

/// Adds the pass that resamples an environment's image, in `texture`, to level 0 of `cube`: six
/// layers of `size` x `size` texels. Returns the cube's new version.
lobe_resource passes_environment_cube(lobe_graph *graph, const lobe_environment *environment,
                                      const lobe_texture *texture, lobe_resource cube,
                                      uint32_t size);

#endif
