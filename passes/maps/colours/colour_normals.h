#ifndef PASSES_MAPS_COLOURS_COLOUR_NORMALS_H
#define PASSES_MAPS_COLOURS_COLOUR_NORMALS_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"

/// A map of how a material's diffuse colours go with its normals, laid out as its lobes are
/// (COLOUR_NORMALS_... in shaders/interface/material.h).

/// Whether a material has such a map: its colours go with normals, the filter does not take them
/// from heights, and lobes are filtered at all.
bool passes_has_colour_normals(const filter_context *context, uint32_t material);

/// Adds the passes that make it, in half floats.
reduced_map passes_colour_normals(const filter_context *context, uint32_t material);

#endif
