#ifndef PASSES_MAPS_WAVES_H
#define PASSES_MAPS_WAVES_H

#include "passes/context/filter.h"
#include "passes/context/material_specialisation.h"

/// Waves on a material (lobe_waves), as the host gives them and filtered.

/// Whether the material has waves and the filter draws them.
bool passes_waves_are_drawn(const filter_context *context, const device_material *material);

#define WAVES_BINDINGS 2
/// Stores what shaders/shading/waves/waves.glsl reads, the maps as they are; returns their number.
size_t passes_waves_bind(const filter_context *context, const device_material *material,
                         lobe_binding bindings[WAVES_BINDINGS]);
void passes_waves_specialise(const device_material *material, specialisation_list *list);

/// The `build` of a filter that shades from moments of slopes, for a material with waves: makes a
/// map of them (shaders/interface/waves.h), and binds it with the filtered colour maps.
void passes_wave_moments_build(const filter_context *context, uint32_t material,
                               filtered_appearance *appearance);

#endif
