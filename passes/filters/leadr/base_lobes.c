#include "passes/filters/leadr/base_lobes.h"

#include <stdio.h>

#include "passes/maps/filtered_maps.h"
#include "passes/maps/lobe_map.h"
#include "passes/maps/moment_map.h"
#include "passes/maps/seen_tiles.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"
#include "shaders/interface/slope_moments.h"

/// BASE_LOBES_...
static uint32_t variation_of(const device_material *material) {
    const device_map *widths = &material->maps[MAP_WIDTH];
    if (material->material->model != LOBE_MATERIAL_MICROFACET || !widths->use ||
        widths->width * widths->height == 1)
        return BASE_LOBES_ALIKE;
    // Under a mask, colours are those of what it keeps.
    const bool coloured = material->metallic_varies && !material->material->alpha_mask &&
                          passes_bins_may_have_colours(material);
    return coloured ? BASE_LOBES_COLOURED : BASE_LOBES_VARY;
}

static reduced_map make_map(const filter_context *context, uint32_t index, uint32_t variation) {
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    const bool coloured = variation == BASE_LOBES_COLOURED;
    char name[64];
    snprintf(name, sizeof name, "base lobes of material %u", index);
    reduced_map map =
        passes_seen_map_declare(context, index, name, passes_filtered_map_format(context),
                                coloured ? BASE_LOBE_LAYER_METAL + 1 : BASE_LOBE_LAYER_METAL, true);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "base_lobes");
    passes_base_maps_read(context, material, false, pass);
    if (coloured)
        passes_base_map_read(context, material, MAP_BASE_COLOUR, "base_colour_map", pass);
    else
        lobe_pass_read(pass, &(lobe_binding){.name = "base_colour_map",
                                             .resource = lobe_graph_import_texture(
                                                 context->graph, context->scene->white)});
    passes_reduced_map_write(&map, pass, "base_lobe_map", 0);
    specialisation_list list = {.graph = context->graph};
    passes_base_maps_specialise(material, &list);
    passes_specialise(&list, SPECIALISE_BASE_LOBES, variation);
    const struct lobe_grid_constants extent = {.width = grid.width, .height = grid.height};
    lobe_dispatch dispatch = {.shader = context->marks ? "filters/leadr/base_lobes_seen_tiles.comp"
                                                       : "filters/leadr/base_lobes.comp",
                              .constants = &extent,
                              .constants_size = sizeof extent,
                              .specialisation = list.items,
                              .specialisation_count = list.count};
    passes_reduced_map_dispatch(&map, pass, 0, 1, &dispatch);
    passes_level_reduction(context->graph, &map);
    return map;
}

void passes_base_lobes_build(const filter_context *context, uint32_t index,
                             filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    const uint32_t variation = variation_of(material);
    lobe_resource resource = lobe_graph_import_texture(context->graph, context->scene->white);
    if (variation != BASE_LOBES_ALIKE) {
        const reduced_map map = make_map(context, index, variation);
        appearance->bytes += passes_reduced_map_bytes(&map, passes_filtered_map_format(context));
        resource = map.resource;
    }
    passes_appearance_bind(
        appearance, "base_lobe_map", resource,
        passes_filtered_map_sampler(context, material, passes_lobe_grid(material).map));
    passes_appearance_specialise(appearance, SPECIALISE_BASE_LOBES, variation);
}
