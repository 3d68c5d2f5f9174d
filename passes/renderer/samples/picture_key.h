#ifndef PASSES_RENDERER_SAMPLES_PICTURE_KEY_H
#define PASSES_RENDERER_SAMPLES_PICTURE_KEY_H

#include <lobe/graph.h>

/// Adds the pass that sums what the picture's key is made of: how bright a radiance is that counts
/// as medium in this picture. Returns a buffer of struct key_sum, one for each tile.
lobe_resource passes_picture_key(lobe_graph *graph, lobe_resource radiance, uint32_t width,
                                 uint32_t height);
uint32_t passes_picture_key_tiles(uint32_t width, uint32_t height);

#endif
