#ifndef PASSES_MAPS_BASE_MAPS_H
#define PASSES_MAPS_BASE_MAPS_H

#include "passes/context/filter.h"
#include "passes/context/material_specialisation.h"

/// A material's own maps, for passes that build filtered maps from them.

/// Binds what shaders/maps/base_maps.glsl reads: a material's constants, normal and width map.
/// `colours`: the shader also reads the constants' colours and metal, and depends on them.
void passes_base_maps_read(const filter_context *context, const device_material *material,
                           bool colours, lobe_pass *pass);
/// Binds one map of a material with its sampler, as shading reads it.
void passes_base_map_read(const filter_context *context, const device_material *material,
                          uint32_t map, const char *name, lobe_pass *pass);
/// The constants of the material and of shaders/maps/base_maps.glsl.
void passes_base_maps_specialise(const device_material *material, specialisation_list *list);

/// The colour maps, or white where the shader's constants say that it reads none: it then depends
/// on no map of colours.
void passes_colour_maps_read(const filter_context *context, const device_material *material,
                             bool reads, lobe_pass *pass);

#endif
