#include "passes/maps/parameter_averaging.h"

#include <stdio.h>

#include "passes/maps/base_maps.h"
#include "passes/maps/filtered_maps.h"
#include "passes/renderer/material_specialisation.h"
#include "shaders/interface/clustering.h"
#include "shaders/interface/mixture.h"

reduced_map passes_parameter_averaging(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    uint32_t width, height;
    passes_lobe_map_extent(material, &width, &height);
    char name[64];
    snprintf(name, sizeof name, "averaged parameters of material %u", index);
    reduced_map map = passes_reduced_map_declare(
        context->graph, name, passes_filtered_map_format(context), width, height, 1);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "parameter_averaging");
    passes_base_maps_read(context, material, false, pass);
    map.resource = lobe_pass_write(
        pass, &(lobe_binding){"parameter_map", map.resource, .range = {0, 1, 0, 1}});
    specialisation_list list = {0};
    passes_material_specialise(material, &list);
    struct clustering_constants constants = {width, height};
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "maps/parameter_averaging.comp",
                                 .threads = {map.width, map.height, 1},
                                 .constants = &constants,
                                 .constants_size = sizeof constants,
                                 .specialisation = list.items,
                                 .specialisation_count = list.count,
                             });
    passes_level_reduction(context->graph, &map);
    return map;
}

void passes_parameter_averaging_build(const filter_context *context, size_t instance,
                                      filtered_appearance *appearance) {
    uint32_t index = context->scene->instances[instance].material;
    const device_material *material = &context->scene->materials[index];
    uint32_t width, height;
    bool averaged = passes_lobe_map_extent(material, &width, &height) && width * height > 1;
    uint32_t map = material->maps[MAP_NORMAL].use ? MAP_NORMAL : MAP_WIDTH;
    lobe_resource resource;
    if (averaged) {
        reduced_map reduced = passes_parameter_averaging(context, index);
        resource = reduced.resource;
        appearance->bytes = passes_reduced_map_bytes(&reduced, passes_filtered_map_format(context));
        appearance->base_texels = (uint64_t)width * height;
    } else {
        resource = lobe_graph_import_texture(context->graph, context->scene->white);
    }
    passes_appearance_bind(appearance, "parameter_map", resource,
                           passes_filtered_map_sampler(material, map));
    passes_appearance_specialise(appearance, SPECIALISE_MIXTURE, averaged);
    passes_filtered_maps_build(context, index, appearance);
}
