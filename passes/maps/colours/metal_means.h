#ifndef PASSES_MAPS_COLOURS_METAL_MEANS_H
#define PASSES_MAPS_COLOURS_METAL_MEANS_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"

/// A map of where microfacets are metal, and of their colours there, laid out as their lobes are,
/// or where widths lie apart as these (METAL_LAYER_... in shaders/interface/material.h). It takes
/// the place of the filtered base colour and metal of materials that are metal in places.

/// METAL_MEANS_...: whether a material has such a map, and what it holds.
uint32_t passes_metal_means_of(const device_material *material);

/// The map (MAP_...) whose coordinates and wrapping it has.
uint32_t passes_metal_means_lie_as(const device_material *material);

/// Adds the passes that make it, in half floats.
reduced_map passes_metal_means(const filter_context *context, uint32_t material);

#endif
