#include "passes/filters/mixture/projected_map.h"

#include "passes/maps/lobe_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/moment_bins.h"

void passes_projected_map_build(const filter_context *context, size_t instance,
                                const mixture_kind *kind, filtered_appearance *appearance) {
    const uint32_t material = context->scene->instances[instance].material;
    const lobe_grid grid = passes_lobe_grid(&context->scene->materials[material]);
    const bool varies = passes_lobe_grid_varies(&grid);
    moment_map mixture;
    if (varies)
        mixture = passes_mixture_map(context, material, kind);
    passes_lobe_map_bind(context, material, "moment_map", varies ? &mixture.map : NULL,
                         kind->format, appearance);
    passes_appearance_specialise(appearance, SPECIALISE_BINS, kind->components);
}
