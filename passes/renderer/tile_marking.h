#ifndef PASSES_RENDERER_TILE_MARKING_H
#define PASSES_RENDERER_TILE_MARKING_H

#include "passes/renderer/renderer.h"

/// Adds the passes that mark which tiles of the maps of lobes the picture's pixels read, if the
/// filter's knobs ask for that (passes/maps/seen_tiles.h), and tells the filter. Comes after
/// passes_instances_list, and before the maps.
/// `targets`: of the picture; NULL: of one that is not drawn. Where shading is deferred, the
/// picture of surfaces is drawn now, with the targets' depth, and kept for shading.
void passes_tile_marking(rendering *r, shading_targets *targets);

#endif
