#include "passes/filters/material_shading.h"

#include <stdio.h>

#include "passes/context/knob_values.h"
#include "passes/maps/waves.h"
#include "passes/upload/material_maps.h"

static const char *const map_names[MAP_SHADING] = {
    [MAP_BASE_COLOUR] = "base_colour_map",
    [MAP_NORMAL] = "normal_map",
    [MAP_WIDTH] = "width_map",
    [MAP_SPECULAR] = "specular_map",
    [MAP_EMISSIVE] = "emissive_map",
    [MAP_OCCLUSION] = "occlusion_map",
};

void passes_material_maps_bind(const filter_context *context, const device_material *material,
                               lobe_binding bindings[MAP_SHADING]) {
    for (uint32_t map = 0; map < MAP_SHADING; map++)
        bindings[map] = (lobe_binding){
            .name = map_names[map],
            .resource = passes_device_map_import(context->graph, context->scene, material, map),
            .sampler = passes_device_map_sampler(material, map)};
}

size_t passes_material_shading_bind(const filter_context *context, const environment_light *light,
                                    const device_material *material,
                                    const filtered_appearance *appearance,
                                    lobe_binding bindings[MATERIAL_SHADING_BINDINGS]) {
    lobe_graph *graph = context->graph;
    size_t count = 0;
    bindings[count++] = (lobe_binding){
        .name = "material_block", .resource = lobe_graph_import_buffer(graph, material->constants)};
    passes_material_maps_bind(context, material, bindings + count);
    count += MAP_SHADING;
    count += passes_environment_light_bind_material(light, context, material->material,
                                                    bindings + count);
    for (size_t i = 0; i < appearance->binding_count; i++)
        bindings[count++] = appearance->bindings[i];
    if (passes_waves_are_drawn(context, material))
        count += passes_waves_bind(context, material, bindings + count);
    return count;
}

void passes_material_shading_specialise(const filter_context *context,
                                        const environment_light *light,
                                        const device_material *material,
                                        const filtered_appearance *appearance,
                                        specialisation_list *list) {
    passes_material_specialise(material, list);
    passes_environment_light_specialise(light, context, material, list);
    passes_knobs_specialise(context, list);
    if (passes_waves_are_drawn(context, material))
        passes_waves_specialise(material, list);
    for (size_t i = 0; i < appearance->specialisation_count; i++)
        passes_specialise(list, appearance->specialisation[i].id,
                          appearance->specialisation[i].bits);
}

/// Half-vector lobes include their own masking.
bool passes_material_shading_is_closed(const filter_context *context,
                                       const device_material *material) {
    return passes_closes_surfaces(context) &&
           material->material->model == LOBE_MATERIAL_MICROFACET &&
           material->map_bits & 1u << MAP_NORMAL;
}

void passes_material_shading_name(const filter_context *context, const environment_light *light,
                                  const device_material *material, bool aov,
                                  char name[SHADING_NAME_SIZE]) {
    snprintf(name, SHADING_NAME_SIZE, "shading/shading_%s%s%s%s%s.frag", context->filter->shading,
             light->present ? "_environment" : "", aov ? "_aov" : "",
             passes_material_shading_is_closed(context, material) ? "_closed_surface" : "",
             passes_waves_are_drawn(context, material) ? "_waves" : "");
}
