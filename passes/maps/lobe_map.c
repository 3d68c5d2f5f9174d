#include "passes/maps/lobe_map.h"

#include <stdio.h>

#include "passes/maps/filtered_maps.h"
#include "passes/maps/seen_tiles.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"
#include "shaders/interface/specialisation.h"

void passes_lobe_map_bind(const filter_context *context, uint32_t material, const char *binding,
                          const reduced_map *map, lobe_format format,
                          filtered_appearance *appearance) {
    const device_material *uploaded = &context->scene->materials[material];
    const lobe_grid grid = passes_lobe_grid(uploaded);
    lobe_resource resource =
        map ? map->resource : lobe_graph_import_texture(context->graph, context->scene->white);
    lobe_sampler sampler = passes_filtered_map_sampler(context, uploaded, grid.map);
    if (context->filter->fetches_texels)
        sampler.texels = sampler.levels = LOBE_SAMPLE_NEAREST;
    passes_appearance_bind(appearance, binding, resource, sampler);
    passes_appearance_specialise(appearance, SPECIALISE_FILTERED_LOBES, map != NULL);
    passes_filtered_maps_build(context, material, appearance);
    if (!map)
        return;
    appearance->bytes = passes_reduced_map_bytes(map, format);
    appearance->base_texels = (uint64_t)grid.width * grid.height;
}

reduced_map passes_lobe_map(const filter_context *context, uint32_t index,
                            const lobe_map_kind *kind) {
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    char name[64];
    snprintf(name, sizeof name, "%s of material %u", kind->content, index);
    reduced_map map = passes_seen_map_declare(
        context, index, name, passes_filtered_map_format(context), kind->layers, true);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, kind->pass);
    passes_base_maps_read(context, material, false, pass);
    passes_reduced_map_write(&map, pass, kind->binding, 0);
    specialisation_list list = {.graph = context->graph};
    passes_base_maps_specialise(material, &list);
    if (kind->read_more)
        kind->read_more(context, material, pass, &list);
    const struct lobe_grid_constants extent = {.width = grid.width, .height = grid.height};
    lobe_dispatch dispatch = {.shader = context->marks ? kind->seen_shader : kind->shader,
                              .constants = &extent,
                              .constants_size = sizeof extent,
                              .specialisation = list.items,
                              .specialisation_count = list.count};
    passes_reduced_map_dispatch(&map, pass, 0, 1, &dispatch);
    passes_level_reduction(context->graph, &map);
    return map;
}

void passes_lobe_map_build(const filter_context *context, size_t instance,
                           const lobe_map_kind *kind, filtered_appearance *appearance) {
    const uint32_t index = context->scene->instances[instance].material;
    const lobe_grid grid = passes_lobe_grid(&context->scene->materials[index]);
    const bool varies = passes_lobe_grid_varies(&grid);
    reduced_map map;
    if (varies)
        map = passes_lobe_map(context, index, kind);
    passes_lobe_map_bind(context, index, kind->binding, varies ? &map : NULL,
                         passes_filtered_map_format(context), appearance);
}
