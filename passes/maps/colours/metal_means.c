#include "passes/maps/colours/metal_means.h"

#include <stdio.h>

#include "passes/context/material_specialisation.h"
#include "passes/maps/seen_tiles.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"
#include "shaders/interface/material.h"
#include "shaders/interface/specialisation.h"

static bool has_texels(const device_map *map) {
    return map->use && map->width * map->height > 1;
}

uint32_t passes_metal_means_of(const device_material *material) {
    if (!material->metallic_varies || !has_texels(&material->maps[MAP_WIDTH]) ||
        !passes_lies_under_lobes(material, MAP_WIDTH))
        return METAL_MEANS_NONE;
    // Under a mask, colours are those of what it keeps.
    const bool coloured = has_texels(&material->maps[MAP_BASE_COLOUR]) &&
                          !material->material->alpha_mask &&
                          passes_lies_under_lobes(material, MAP_BASE_COLOUR);
    return coloured ? METAL_MEANS_COLOURED : METAL_MEANS_ALONE;
}

static void read_map(const filter_context *context, const device_material *material, uint32_t map,
                     const char *name, lobe_pass *pass) {
    lobe_pass_read(pass, &(lobe_binding){.name = name,
                                         .resource = passes_device_map_import(
                                             context->graph, context->scene, material, map),
                                         .sampler = passes_device_map_sampler(material, map)});
}

reduced_map passes_metal_means(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const bool coloured = passes_metal_means_of(material) == METAL_MEANS_COLOURED;
    char name[64];
    snprintf(name, sizeof name, "metal of material %u", index);
    reduced_map map =
        passes_seen_map_declare(context, index, name, LOBE_FORMAT_RGBA16_FLOAT,
                                coloured ? METAL_LAYER_COLOUR + 1 : METAL_LAYER_METAL + 1, true);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "metal_means");
    read_map(context, material, MAP_WIDTH, "width_map", pass);
    if (coloured)
        read_map(context, material, MAP_BASE_COLOUR, "base_colour_map", pass);
    else
        lobe_pass_read(pass, &(lobe_binding){.name = "base_colour_map",
                                             .resource = lobe_graph_import_texture(
                                                 context->graph, context->scene->white)});
    passes_reduced_map_write(&map, pass, "metal_map", 0);
    specialisation_list list = {.graph = context->graph};
    passes_specialise(&list, SPECIALISE_METAL_MEANS, passes_metal_means_of(material));
    passes_specialise(
        &list, SPECIALISE_INTERPOLATED,
        passes_device_map_is_interpolated(material, MAP_WIDTH) ||
            (coloured && passes_device_map_is_interpolated(material, MAP_BASE_COLOUR)));
    const lobe_grid grid = passes_lobe_grid(material);
    const struct lobe_grid_constants extent = {.width = grid.width, .height = grid.height};
    lobe_dispatch dispatch = {.shader = context->marks ? "maps/metal_means_seen_tiles.comp"
                                                       : "maps/metal_means.comp",
                              .constants = &extent,
                              .constants_size = sizeof extent,
                              .specialisation = list.items,
                              .specialisation_count = list.count};
    passes_reduced_map_dispatch(&map, pass, 0, 1, &dispatch);
    passes_level_reduction(context->graph, &map);
    return map;
}
