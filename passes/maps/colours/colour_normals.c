#include "passes/maps/colours/colour_normals.h"

#include <stdio.h>

#include "passes/maps/base_maps.h"
#include "passes/maps/seen_tiles.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"
#include "shaders/interface/material.h"

bool passes_has_colour_normals(const filter_context *context, uint32_t index) {
    return context->scene->materials[index].colours.follow_normals &&
           !context->filter->reads_heights;
}

reduced_map passes_colour_normals(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    char name[64];
    snprintf(name, sizeof name, "normals of colours of material %u", index);
    reduced_map map = passes_seen_map_declare(context, index, name, LOBE_FORMAT_RGBA16_FLOAT,
                                              COLOUR_NORMALS_LAYERS, true);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "colour_normals");
    passes_base_maps_read(context, material, false, pass);
    passes_base_map_read(context, material, MAP_BASE_COLOUR, "base_colour_map", pass);
    passes_reduced_map_write(&map, pass, "colour_normal_map", 0);
    specialisation_list list = {.graph = context->graph};
    passes_base_maps_specialise(material, &list);
    const struct lobe_grid_constants extent = {.width = grid.width, .height = grid.height};
    lobe_dispatch dispatch = {.shader = context->marks ? "maps/colour_normals_seen_tiles.comp"
                                                       : "maps/colour_normals.comp",
                              .constants = &extent,
                              .constants_size = sizeof extent,
                              .specialisation = list.items,
                              .specialisation_count = list.count};
    passes_reduced_map_dispatch(&map, pass, 0, 1, &dispatch);
    passes_level_reduction(context->graph, &map);
    return map;
}
