#ifndef PASSES_RENDERER_INSTANCE_MAPS_H
#define PASSES_RENDERER_INSTANCE_MAPS_H

#include "passes/renderer/renderer.h"

/// Adds the passes that build the filter's maps for every instance; instances share maps where the
/// filter allows it. Fills the renderer's appearances, and the frame's sizes of the maps.
void passes_instance_maps_build(rendering *r, lobe_frame *frame);

/// Warns of materials that the filter cannot represent fully, once for each filter and scene.
void passes_instance_maps_warn(const rendering *r);

#endif
