#ifndef PASSES_RENDERER_SURFACES_MASKS_H
#define PASSES_RENDERER_SURFACES_MASKS_H

#include "passes/context/material_specialisation.h"
#include "passes/renderer/draw_list.h"

/// What cuts the holes of a masked material into the picture of surfaces: the maps and constants of
/// shading/mask.glsl, as the filter built them.

enum { SURFACE_MASK_BINDINGS = 5 + MAP_SHADING };

void passes_surface_mask_bind(const filter_context *context, const instance_batch *batch,
                              lobe_binding bindings[SURFACE_MASK_BINDINGS]);
void passes_surface_mask_specialise(const filter_context *context, const instance_batch *batch,
                                    specialisation_list *list);

#endif
