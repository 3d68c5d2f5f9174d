#include "passes/filters/mixture/record.h"

#include "passes/context/fit_work.h"
#include "passes/filters/mixture/mixture_key.h"
#include "passes/maps/kept/record.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/moment_bins.h"

static bool varies(const device_material *material) {
    const lobe_grid grid = passes_lobe_grid(material);
    return passes_lobe_grid_varies(&grid);
}

static uint64_t key(const filter_context *context, uint32_t index, const void *user) {
    return passes_mixture_key(context, &context->scene->materials[index], user);
}

/// All levels in one.
static kept_tile tile(const filter_context *context, uint32_t index, const void *user,
                      uint32_t number) {
    (void)number;
    const device_material *material = &context->scene->materials[index];
    return (kept_tile){.layout = {.what = "mixture",
                                  .images = {passes_mixture_extent(material, user)},
                                  .image_count = 1,
                                  .buffer_bytes = {sizeof(struct moment_binning_constants)},
                                  .buffer_count = 1},
                       .parts = passes_mixture_part_count(material, user)};
}

lobe_result passes_mixture_prepare(const filter_context *context, uint32_t index,
                                   const mixture_kind *kind, void **slot) {
    const device_material *material = &context->scene->materials[index];
    if (!context->work || context->work->is_dry || !varies(material))
        return LOBE_OK;
    const kept_subject subject = {
        .kind = passes_mixture_kind_digest(context, kind),
        .inputs = passes_mixture_inputs(context, material, kind->own_colours),
        .has_texels = passes_mixture_has_texels(context, material, kind->own_colours),
        .tile_count = 1,
        .tile = tile,
        .key = key,
        .user = kind,
    };
    return passes_kept_prepare(context, index, &subject, slot);
}

bool passes_mixture_build(const filter_context *context, uint32_t index, const mixture_kind *kind,
                          const void *prepared, moment_map *mixture) {
    if (!varies(&context->scene->materials[index]))
        return false;
    const stored_content *stored = passes_kept_stored(context, prepared, 0);
    if (stored) {
        *mixture = passes_mixture_map_declare(context, index, kind);
        const kept_image extent = passes_mixture_extent(&context->scene->materials[index], kind);
        passes_restoring(context->graph, stored, 0, &(map_tile){.extent = extent}, &mixture->map);
        mixture->bins = lobe_graph_import_buffer(context->graph, stored->buffers[0]);
        return true;
    }
    bool in_parts;
    const uint32_t parts = passes_kept_parts(context, prepared, &in_parts);
    *mixture = in_parts ? passes_mixture_map_parts(context, index, kind, parts)
                        : passes_mixture_map(context, index, kind);
    return passes_kept_built(context, prepared, &mixture->map.resource, &mixture->bins);
}
