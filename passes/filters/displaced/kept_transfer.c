#include "passes/filters/displaced/kept_transfer.h"

#include "passes/context/digest.h"
#include "passes/context/fit_work.h"
#include "passes/filters/displaced/relief.h"
#include "passes/maps/kept/record.h"
#include "passes/maps/kept/texels.h"

/// Increment it whenever the same relief gets other maps: old files are then no longer found.
enum { TRANSFER_FILE_VERSION = 3 };

static uint64_t kind_digest(const transfer_kind *kind) {
    const uint64_t numbers[] = {kind->order,   kind->azimuths,
                                kind->bounces, (uint64_t)kind->format,
                                kind->normals, kind->coloured};
    return passes_digest_bytes(TRANSFER_FILE_VERSION, numbers, sizeof numbers);
}

/// The maps that are read, by MAP_...
static bool is_read(const device_material *material, const transfer_kind *kind, uint32_t map) {
    return map == MAP_HEIGHT || (kind->coloured && material->maps[map].use &&
                                 (map == MAP_BASE_COLOUR || map == MAP_WIDTH));
}

/// The numbers that are read.
static uint64_t numbers_digest(const device_material *material, const transfer_kind *kind,
                               uint64_t digest) {
    const lobe_material *source = material->material;
    digest = passes_digest_bytes(digest, &source->height_scale, sizeof source->height_scale);
    if (!kind->coloured)
        return digest;
    digest = passes_digest_bytes(digest, material->values.base_colour,
                                 sizeof material->values.base_colour);
    digest =
        passes_digest_bytes(digest, &material->values.metallic, sizeof material->values.metallic);
    return passes_digest(digest, material->metallic_varies);
}

static uint64_t inputs_digest(const device_material *material, const transfer_kind *kind) {
    uint64_t digest = numbers_digest(material, kind, material->parameter_version);
    for (uint32_t map = 0; map < MAP_COUNT; map++)
        if (is_read(material, kind, map))
            digest = passes_digest(digest, material->texel_versions[map]);
    return digest;
}

static uint64_t key(const filter_context *context, uint32_t index, const void *user) {
    const device_material *material = &context->scene->materials[index];
    const transfer_kind *kind = user;
    uint64_t digest = numbers_digest(material, kind, kind_digest(kind));
    digest = passes_digest(digest, (uint64_t)material->material->model);
    for (uint32_t map = 0; map < MAP_COUNT; map++)
        if (is_read(material, kind, map))
            digest = passes_kept_map_digest(&material->maps[map], passes_digest(digest, map));
    return digest;
}

static bool has_texels(const filter_context *context, const device_material *material,
                       const transfer_kind *kind) {
    for (uint32_t map = 0; map < MAP_COUNT; map++)
        if (is_read(material, kind, map) && !passes_kept_has_texels(context, &material->maps[map]))
            return false;
    return true;
}

/// What the maps take.
static kept_layout layout_of_maps(const device_material *material, const transfer_kind *kind) {
    kept_layout layout = {.what = "relief",
                          .buffer_bytes = {sizeof(struct transfer_closure_constants)},
                          .buffer_count = 1};
    layout.image_count = passes_transfer_images(material, kind, layout.images);
    return layout;
}

static facet_range range_of_share(const filter_context *context, uint32_t index, uint32_t share) {
    const device_map *heights = &context->scene->materials[index].maps[MAP_HEIGHT];
    return passes_facets_share(heights, share, context->work->shares);
}

/// A share's file has what a range of facets sees.
static kept_layout layout_of_share(const filter_context *context, uint32_t index, const void *user,
                                   uint32_t share) {
    const facet_range range = range_of_share(context, index, share);
    kept_layout layout = {.what = "relief", .share = share, .shares = context->work->shares};
    if (range.count == 0)
        return layout;
    layout.buffer_count = 3;
    passes_facets_bytes(range, user, layout.buffer_bytes);
    return layout;
}

static bool makes_share(const filter_context *context) {
    return context->work && !context->work->is_dry && context->work->share > 0;
}

/// Joining takes one part.
static uint32_t part_count(const filter_context *context, uint32_t index,
                           const transfer_kind *kind) {
    if (makes_share(context))
        return passes_facets_part_count(range_of_share(context, index, context->work->share), kind);
    return context->work->shares > 0
               ? 1
               : passes_transfer_part_count(&context->scene->materials[index], kind);
}

lobe_result passes_kept_transfer_prepare(const filter_context *context, uint32_t index,
                                         const transfer_kind *kind, void **slot) {
    const device_material *material = &context->scene->materials[index];
    const fit_work *work = context->work;
    if (!work || work->is_dry || !passes_has_relief(material) ||
        (work->shares > 0 && !passes_transfer_is_whole(material, kind)))
        return LOBE_OK;
    const kept_subject subject = {
        .kind = passes_digest(kind_digest(kind), (uint64_t)work->share << 32 | work->shares),
        .inputs = inputs_digest(material, kind),
        .parts = part_count(context, index, kind),
        .has_texels = has_texels(context, material, kind),
        .layout = makes_share(context) ? layout_of_share(context, index, kind, work->share)
                                       : layout_of_maps(material, kind),
        .share = layout_of_share,
        .key = key,
        .user = kind,
    };
    return subject.layout.buffer_count > 0 ? passes_kept_prepare(context, index, &subject, slot)
                                           : LOBE_OK;
}

static bool can_share(const filter_context *context, uint32_t index, const transfer_kind *kind) {
    const device_material *material = &context->scene->materials[index];
    if (passes_transfer_is_whole(material, kind))
        return true;
    const device_map *map = &material->maps[MAP_HEIGHT];
    lobe_graph_fail(context->graph, LOBE_ERROR_LIMIT,
                    "%s: a height map of %u x %u texels is too large to be shared by several "
                    "processes: it has more than %.1f million",
                    material->material->name, map->width, map->height,
                    (double)passes_window_limit() / 2e6);
    return false;
}

/// What the facets of the frame's share see is all that is made.
static void build_share(const filter_context *context, uint32_t index, const transfer_kind *kind,
                        const void *prepared) {
    if (!prepared || passes_kept_stored(context, prepared))
        return;
    bool in_parts;
    const uint32_t parts = passes_kept_parts(context, prepared, &in_parts);
    const relief relief = passes_relief(context, index, in_parts);
    const facet_range range = range_of_share(context, index, context->work->share);
    const facets_request request = {context->graph, index, &relief, kind, in_parts};
    const facet_window window = {.width = relief.constants.width,
                                 .height = relief.constants.height};
    seen_facets seen = passes_facets_begin(&request, range.count);
    passes_facets_add(&request, &window, range, parts, in_parts, &seen);
    const lobe_resource buffers[] = {seen.words, seen.links, seen.basis};
    (void)passes_kept_built(context, prepared, NULL, buffers);
}

static transfer_map make(const filter_context *context, uint32_t index, const transfer_kind *kind,
                         const void *prepared, const relief *relief, uint32_t parts,
                         bool in_parts) {
    const stored_content *joined = passes_kept_joined(context, prepared);
    if (!joined)
        return passes_transfer_map(context, index, kind, relief, NULL, parts, in_parts);
    const seen_facets seen = {.words = lobe_graph_import_buffer(context->graph, joined->buffers[0]),
                              .links = lobe_graph_import_buffer(context->graph, joined->buffers[1]),
                              .basis =
                                  lobe_graph_import_buffer(context->graph, joined->buffers[2])};
    return passes_transfer_map(context, index, kind, relief, &seen, parts, in_parts);
}

bool passes_kept_transfer_build(const filter_context *context, uint32_t index,
                                const transfer_kind *kind, const void *prepared, bool near,
                                transfer_map *transfer, relief *relief) {
    if (context->work && context->work->shares > 0 && !can_share(context, index, kind))
        return false;
    if (makes_share(context)) {
        build_share(context, index, kind, prepared);
        return false;
    }
    const stored_content *stored = passes_kept_stored(context, prepared);
    if (stored) {
        if (near)
            *relief = passes_relief(context, index, true);
        *transfer = passes_transfer_map_declare(context, index, kind);
        passes_restoring(context->graph, stored, 0, &transfer->map);
        if (kind->normals)
            passes_restoring(context->graph, stored, 1, &transfer->facets);
        transfer->closure = lobe_graph_import_buffer(context->graph, stored->buffers[0]);
        return true;
    }
    bool in_parts;
    const uint32_t parts = passes_kept_parts(context, prepared, &in_parts);
    *relief = passes_relief(context, index, near || in_parts);
    *transfer = make(context, index, kind, prepared, relief, parts, in_parts);
    const lobe_resource images[] = {transfer->map.resource, transfer->facets.resource};
    return passes_kept_built(context, prepared, images, &transfer->closure);
}
