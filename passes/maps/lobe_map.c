#include "passes/maps/lobe_map.h"

#include "passes/maps/filtered_maps.h"
#include "passes/upload/material_maps.h"
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
    passes_appearance_specialise(appearance, SPECIALISE_MASKED_LOBES,
                                 passes_lobes_are_masked(uploaded));
    passes_filtered_maps_build(context, material, appearance);
    if (!map)
        return;
    appearance->bytes = passes_reduced_map_bytes(map, format);
    appearance->base_texels = (uint64_t)grid.width * grid.height;
}

void passes_lobe_map_build(const filter_context *context, size_t instance,
                           const lobe_map_kind *kind, filtered_appearance *appearance) {
    const uint32_t index = context->scene->instances[instance].material;
    const lobe_grid grid = passes_lobe_grid(&context->scene->materials[index]);
    const bool varies = passes_lobe_grid_varies(&grid);
    const lobe_format format = passes_filtered_map_format(context);
    reduced_map map;
    if (varies)
        map = passes_lobe_map(context, index, kind, format);
    passes_lobe_map_bind(context, index, kind->binding, varies ? &map : NULL, format, appearance);
}
