#ifndef PASSES_RENDERER_TILE_MARKING_H
#define PASSES_RENDERER_TILE_MARKING_H

#include "passes/renderer/renderer.h"

/// Adds the passes that mark which tiles of the maps of lobes the picture's pixels read, if the
/// filter's knobs ask for that (passes/maps/seen_tiles.h), and tells the filter. Comes after what
/// the host gives in this frame, and before the maps. Uses the renderer's list of draws.
void passes_tile_marking(rendering *r);

#endif
