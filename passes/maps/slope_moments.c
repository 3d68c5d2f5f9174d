#include "passes/maps/slope_moments.h"

#include <stdio.h>

#include "passes/maps/base_maps.h"
#include "passes/maps/filtered_maps.h"
#include "passes/renderer/material_specialisation.h"
#include "shaders/interface/slope_moments.h"

reduced_map passes_slope_moments(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    uint32_t width, height;
    passes_lobe_map_extent(material, &width, &height);
    char name[64];
    snprintf(name, sizeof name, "slope moments of material %u", index);
    reduced_map map = passes_reduced_map_declare(
        context->graph, name, passes_filtered_map_format(context), width, height, SLOPE_LAYERS);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "slope_moments");
    passes_base_maps_read(context, material, false, pass);
    map.resource = lobe_pass_write(
        pass, &(lobe_binding){"moment_map", map.resource, .range = {0, 1, 0, SLOPE_LAYERS}});
    specialisation_list list = {0};
    passes_material_specialise(material, &list);
    struct slope_moments_constants constants = {width, height};
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "maps/slope_moments.comp",
                                 .threads = {map.width, map.height, 1},
                                 .constants = &constants,
                                 .constants_size = sizeof constants,
                                 .specialisation = list.items,
                                 .specialisation_count = list.count,
                             });
    passes_level_reduction(context->graph, &map);
    return map;
}

void passes_slope_moments_build(const filter_context *context, size_t instance,
                                filtered_appearance *appearance) {
    uint32_t index = context->scene->instances[instance].material;
    const device_material *material = &context->scene->materials[index];
    uint32_t width, height;
    bool varies = passes_lobe_map_extent(material, &width, &height) && width * height > 1;
    uint32_t map = material->maps[MAP_NORMAL].use ? MAP_NORMAL : MAP_WIDTH;
    lobe_resource resource;
    if (varies) {
        reduced_map reduced = passes_slope_moments(context, index);
        resource = reduced.resource;
        appearance->bytes = passes_reduced_map_bytes(&reduced, passes_filtered_map_format(context));
        appearance->base_texels = (uint64_t)width * height;
    } else {
        resource = lobe_graph_import_texture(context->graph, context->scene->white);
    }
    passes_appearance_bind(appearance, "moment_map", resource,
                           passes_filtered_map_sampler(material, map));
    passes_appearance_specialise(appearance, SPECIALISE_SLOPES, varies);
    passes_filtered_maps_build(context, index, appearance);
}
