#include "passes/parameter_averaging.h"

#include <stdio.h>

#include "passes/base_maps.h"
#include "passes/filtered_maps.h"
#include "passes/material_specialisation.h"
#include "shaders/interface/clustering.h"

reduced_map parameter_averaging(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    uint32_t width, height;
    lobe_map_extent(material, &width, &height);
    char name[64];
    snprintf(name, sizeof name, "averaged parameters of material %u", index);
    reduced_map map =
        reduced_map_declare(context->graph, name, filtered_map_format(context), width, height, 1);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "parameter_averaging");
    base_maps_read(context, material, pass);
    map.resource = lobe_pass_write(
        pass, &(lobe_binding){"parameter_map", map.resource, .range = {0, 1, 0, 1}});
    specialisation_list list = {0};
    material_specialise(material, &list);
    struct clustering_constants constants = {width, height};
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "parameter_averaging.comp",
                                 .threads = {map.width, map.height, 1},
                                 .constants = &constants,
                                 .constants_size = sizeof constants,
                                 .specialisation = list.items,
                                 .specialisation_count = list.count,
                             });
    level_reduction(context->graph, &map);
    return map;
}
