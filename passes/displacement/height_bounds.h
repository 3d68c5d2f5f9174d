#ifndef PASSES_DISPLACEMENT_HEIGHT_BOUNDS_H
#define PASSES_DISPLACEMENT_HEIGHT_BOUNDS_H

#include <lobe/graph.h>

/// A retained buffer of the least and the greatest heights, and of the greatest changes from a
/// texel to the next, of squares of a height map: HEIGHT_BOUNDS_TEXELS of
/// shaders/interface/displacement/displacement.h.
typedef struct height_bounds {
    lobe_resource buffer;
    uint32_t levels;
} height_bounds;

/// Adds the passes that find them. `image`: the map's number, for a name.
height_bounds passes_height_bounds(lobe_graph *graph, lobe_resource heights, uint32_t width,
                                   uint32_t height, int32_t image);

#endif
