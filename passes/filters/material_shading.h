#ifndef PASSES_FILTERS_MATERIAL_SHADING_H
#define PASSES_FILTERS_MATERIAL_SHADING_H

#include "passes/environment/light.h"

/// What shading reads of a material with a filter, whoever draws it.

/// Largest number of bindings of a material.
#define MATERIAL_SHADING_BINDINGS                                                                  \
    (3 + ENVIRONMENT_MATERIAL_BINDINGS + MAP_SHADING + FILTER_MAXIMUM_BINDINGS)

/// All maps that shading reads of a material, as they are; white where it has none.
void passes_material_maps_bind(const filter_context *context, const device_material *material,
                               lobe_binding bindings[MAP_SHADING]);

/// Stores the material's constants, maps and tables, and what the filter built for it; returns
/// their number.
size_t passes_material_shading_bind(const filter_context *context, const environment_light *light,
                                    const device_material *material,
                                    const filtered_appearance *appearance,
                                    lobe_binding bindings[MATERIAL_SHADING_BINDINGS]);

/// Adds the specialisation constants of the material, the environment and the knobs, then the
/// filter's own.
void passes_material_shading_specialise(const filter_context *context,
                                        const environment_light *light,
                                        const device_material *material,
                                        const filtered_appearance *appearance,
                                        specialisation_list *list);

/// Whether the material's normal map is that of a closed surface.
bool passes_material_shading_is_closed(const filter_context *context,
                                       const device_material *material);

#define SHADING_NAME_SIZE 96
/// The variant of the filter's shader that has what the material needs. `aov`: with arbitrary
/// output variables.
void passes_material_shading_name(const filter_context *context, const environment_light *light,
                                  const device_material *material, bool aov,
                                  char name[SHADING_NAME_SIZE]);

#endif
