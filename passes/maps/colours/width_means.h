#ifndef PASSES_MAPS_COLOURS_WIDTH_MEANS_H
#define PASSES_MAPS_COLOURS_WIDTH_MEANS_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"

/// A map of how wide base lobes are, of materials whose widths lie apart from the normals
/// (passes_widths_lie_apart), laid out as the width map is (WIDTH_LAYER_... in
/// shaders/interface/material.h). Lobes count by what they mirror. Maps of lobes leave the widths
/// out, and shading adds them.

/// Adds the passes that make it, in floats.
reduced_map passes_width_means(const filter_context *context, uint32_t material);

#endif
