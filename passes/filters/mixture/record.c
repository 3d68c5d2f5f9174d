#include "passes/filters/mixture/record.h"

#include "passes/context/fit_work.h"
#include "passes/filters/mixture/mixture_file.h"
#include "passes/filters/mixture/mixture_key.h"
#include "passes/filters/mixture/restoring.h"
#include "passes/upload/material_maps.h"

/// What a frame reads back, to be saved.
typedef struct mixture_reading {
    bool waits; ///< it has not been taken yet
    moment_map map;
} mixture_reading;

typedef struct mixture_record {
    uint64_t kind, inputs; ///< digests of what it is for
    bool changed;          ///< texels were replaced
    uint32_t part_count;
    uint32_t done; ///< parts that frames had until now, this one included
    bool in_parts; ///< what later parts need is kept between frames
    bool looked_up, settled;
    uint64_t key; ///< of the file, once looked up
    stored_mixture stored;
    mixture_reading *reading; ///< owned
} mixture_record;

static bool varies(const device_material *material) {
    const lobe_grid grid = passes_lobe_grid(material);
    return passes_lobe_grid_varies(&grid);
}

// ---------------------------------------------------------------------------------------------
// Preparing

static lobe_result create(const filter_context *context, void **slot) {
    const lobe_allocator *allocator = lobe_host_allocator(context->host);
    mixture_record *record = lobe_allocate(allocator, 1, sizeof *record);
    if (!record)
        return LOBE_ERROR_OUT_OF_MEMORY;
    *slot = record;
    record->reading = lobe_allocate(allocator, 1, sizeof *record->reading);
    if (record->reading)
        return LOBE_OK;
    lobe_release(record);
    *slot = NULL;
    return LOBE_ERROR_OUT_OF_MEMORY;
}

/// Starts again with other settings, and leaves what was stored where texels were replaced.
static void update(mixture_record *record, const device_material *material,
                   const mixture_kind *kind, uint64_t kind_digest, uint64_t inputs) {
    const bool other_kind = record->kind != kind_digest;
    record->reading->waits = false;
    if (!other_kind && record->inputs == inputs)
        return;
    passes_stored_mixture_free(&record->stored);
    *record = (mixture_record){.kind = kind_digest,
                               .inputs = inputs,
                               .changed = !other_kind,
                               .part_count = passes_mixture_part_count(material, kind),
                               .reading = record->reading};
}

static bool may_be_stored(const filter_context *context, const device_material *material,
                          const mixture_kind *kind, const mixture_record *record,
                          const mixture_extent *extent) {
    return context->work->cache && !record->changed &&
           passes_mixture_has_texels(context, material, kind->own_colours) &&
           passes_mixture_rows(extent) <= context->work->most_texels;
}

static lobe_result look_up(const filter_context *context, uint32_t index, const mixture_kind *kind,
                           mixture_record *record) {
    const device_material *material = &context->scene->materials[index];
    const mixture_extent extent = passes_mixture_extent(material, kind);
    mixture_image image;
    if (record->looked_up || !may_be_stored(context, material, kind, record, &extent))
        return LOBE_OK;
    record->looked_up = true;
    record->key = passes_mixture_key(context, material, kind);
    if (record->done > 0 || !passes_mixture_file_load(context->work->cache, record->key, &extent,
                                                      context->host, &image))
        return LOBE_OK;
    const lobe_result result =
        passes_stored_mixture_create(context->graph, &image, &record->stored);
    passes_mixture_image_free(&image);
    record->settled = result == LOBE_OK;
    if (result != LOBE_OK)
        passes_stored_mixture_free(&record->stored);
    return result;
}

/// Takes parts of the frame's work.
static void advance(const filter_context *context, const device_material *material,
                    const mixture_kind *kind, mixture_record *record) {
    fit_work *work = context->work;
    const uint32_t left = record->part_count - record->done;
    const bool at_once = record->changed || record->stored.rows ||
                         !passes_mixture_has_texels(context, material, kind->own_colours);
    const uint32_t step = at_once || left < work->parts ? left : work->parts;
    record->in_parts = !at_once && left > 0 && (record->done > 0 || step < left);
    record->done += step;
    if (!at_once && work->parts != UINT32_MAX)
        work->parts -= step;
    work->parts_left += record->part_count - record->done;
}

lobe_result passes_mixture_prepare(const filter_context *context, uint32_t index,
                                   const mixture_kind *kind, void **slot) {
    const device_material *material = &context->scene->materials[index];
    if (!context->work || context->work->is_dry || !varies(material))
        return LOBE_OK;
    lobe_result result = *slot ? LOBE_OK : create(context, slot);
    mixture_record *record = *slot;
    if (result != LOBE_OK)
        return result;
    const uint64_t inputs = passes_mixture_inputs(material, kind->own_colours);
    update(record, material, kind, passes_mixture_kind_digest(context, kind), inputs);
    result = look_up(context, index, kind, record);
    if (result == LOBE_OK)
        advance(context, material, kind, record);
    return result;
}

void passes_mixture_forget(void *slot) {
    mixture_record *record = slot;
    passes_stored_mixture_free(&record->stored);
    lobe_release(record->reading);
    lobe_release(record);
}

// ---------------------------------------------------------------------------------------------
// Building

static void read_back(const filter_context *context, const mixture_record *record,
                      const moment_map *mixture) {
    lobe_graph_read_back(context->graph, mixture->map.resource, (lobe_range){0});
    lobe_graph_read_back(context->graph, mixture->bins, (lobe_range){0});
    *record->reading = (mixture_reading){.waits = true, .map = *mixture};
    context->work->reads_back = true;
}

bool passes_mixture_build(const filter_context *context, uint32_t index, const mixture_kind *kind,
                          const void *prepared, moment_map *mixture) {
    const mixture_record *record = prepared;
    if (!varies(&context->scene->materials[index]))
        return false;
    if (!record || context->work->is_dry) {
        *mixture = passes_mixture_map(context, index, kind);
        return true;
    }
    if (record->stored.rows) {
        *mixture = passes_mixture_map_declare(context, index, kind);
        passes_mixture_restoring(context->graph, &record->stored, mixture);
        return true;
    }
    *mixture = record->in_parts ? passes_mixture_map_parts(context, index, kind, record->done)
                                : passes_mixture_map(context, index, kind);
    const bool is_whole = record->done == record->part_count;
    if (is_whole && record->looked_up && !record->settled && context->work->saves)
        read_back(context, record, mixture);
    return is_whole;
}

void passes_mixture_save(void *slot, const lobe_graph *graph, const char *folder,
                         const lobe_host *host) {
    mixture_record *record = slot;
    if (!record->reading->waits)
        return;
    record->reading->waits = false;
    const moment_map *mixture = &record->reading->map;
    const reduced_map *map = &mixture->map;
    const mixture_extent extent = {mixture->format, map->width, map->height, map->layers,
                                   map->levels};
    const void *bins = lobe_graph_data(graph, mixture->bins, NULL);
    const void *texels = lobe_graph_data(graph, mixture->map.resource, NULL);
    if (!folder || !bins || !texels)
        return;
    passes_mixture_file_save(folder, record->key, &extent, bins, texels, host);
    record->settled = true;
}
