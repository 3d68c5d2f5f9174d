#ifndef PASSES_FILTERS_LOBES_WIDTH_COLOURS_H
#define PASSES_FILTERS_LOBES_WIDTH_COLOURS_H

#include "passes/upload/device_scene.h"

/// Whether, of microfacets that mirror as much as their maps say and whose widths vary, sharp ones
/// and broad ones differ in colour, so that each of two widths needs its own. Decided from a few
/// patches of the maps with the material's factors of colour and metal. True for maps that the host
/// does not read, unless they can have no colour.
bool passes_widths_have_colours(const device_scene *scene, const device_material *material);

#endif
