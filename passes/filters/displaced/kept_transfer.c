#include "passes/filters/displaced/kept_transfer.h"

#include "passes/context/digest.h"
#include "passes/context/fit_work.h"
#include "passes/filters/displaced/relief.h"
#include "passes/maps/kept/texels.h"

/// Increment it whenever the same relief gets other maps: old files are then no longer found.
enum { TRANSFER_FILE_VERSION = 7 };

static uint64_t kind_digest(const transfer_kind *kind) {
    const uint64_t numbers[] = {
        kind->order,    kind->azimuths,         kind->bounces,
        kind->normals,  (uint64_t)kind->format, kind->coloured,
        kind->emissive, kind->widths,           passes_transfer_facets(kind)};
    return passes_digest_bytes(TRANSFER_FILE_VERSION, numbers, sizeof numbers);
}

/// The maps that are read, by MAP_...
static bool is_read(const device_material *material, const transfer_kind *kind, uint32_t map) {
    const bool colours =
        (kind->coloured || kind->emissive) && (map == MAP_BASE_COLOUR || map == MAP_WIDTH);
    const bool widths = kind->widths && map == MAP_WIDTH;
    const bool emission = kind->emissive && map == MAP_EMISSIVE;
    return map == MAP_HEIGHT || (material->maps[map].use && (colours || widths || emission));
}

/// The numbers that are read.
static uint64_t numbers_digest(const device_material *material, const transfer_kind *kind,
                               uint64_t digest) {
    const lobe_material *source = material->material;
    digest = passes_digest_bytes(digest, &source->height_scale, sizeof source->height_scale);
    if (!kind->coloured && !kind->emissive)
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

static window_grid grid_of(const filter_context *context, uint32_t index,
                           const transfer_kind *kind) {
    return passes_transfer_grid(&context->scene->materials[index], kind);
}

/// Which windows' tiles the frame makes.
typedef struct tile_choice {
    uint32_t first, step, count;
} tile_choice;

/// All of them, or those of its share.
static tile_choice choose_tiles(const filter_context *context, uint32_t index,
                                const transfer_kind *kind) {
    const window_grid grid = grid_of(context, index, kind);
    const uint32_t count = grid.columns * grid.rows, share = context->work->share,
                   first = share > 0 ? share - 1 : 0, step = share > 0 ? context->work->shares : 1;
    return (tile_choice){first, step, first < count ? (count - 1 - first) / step + 1 : 0};
}

/// Maps that are made in one window are shared by facets, others by windows.
static bool shares_facets(const filter_context *context, uint32_t index,
                          const transfer_kind *kind) {
    return context->work->shares > 0 &&
           passes_transfer_is_whole(&context->scene->materials[index], kind);
}

/// Whether tiles of a map that is made in windows are to be saved, and nothing else.
static bool makes_tiles_alone(const filter_context *context, uint32_t index,
                              const transfer_kind *kind) {
    const fit_work *work = context->work;
    return work && !work->is_dry && work->draws_nothing && work->saves &&
           !passes_transfer_is_whole(&context->scene->materials[index], kind);
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

static bool makes_share_of_facets(const filter_context *context, uint32_t index,
                                  const transfer_kind *kind) {
    return context->work && !context->work->is_dry && context->work->share > 0 &&
           shares_facets(context, index, kind);
}

static kept_tile share(const filter_context *context, uint32_t index, const void *user,
                       uint32_t number) {
    (void)number;
    const uint32_t share = context->work->share;
    return (kept_tile){.layout = layout_of_share(context, index, user, share),
                       .parts =
                           passes_facets_part_count(range_of_share(context, index, share), user)};
}

/// Joining takes one part.
static kept_tile tile(const filter_context *context, uint32_t index, const void *user,
                      uint32_t number) {
    const tile_choice choice = choose_tiles(context, index, user);
    kept_tile tile = passes_transfer_tile(&context->scene->materials[index], user,
                                          choice.first + number * choice.step);
    if (shares_facets(context, index, user))
        tile.parts = 1;
    return tile;
}

static kept_subject subject_of(const filter_context *context, uint32_t index,
                               const transfer_kind *kind) {
    const device_material *material = &context->scene->materials[index];
    const fit_work *work = context->work;
    const bool shares = makes_share_of_facets(context, index, kind);
    const uint32_t count = shares ? range_of_share(context, index, work->share).count > 0
                                  : choose_tiles(context, index, kind).count;
    const bool alone = shares || makes_tiles_alone(context, index, kind);
    const uint64_t share_digest =
        passes_digest(kind_digest(kind), (uint64_t)work->share << 32 | work->shares);
    return (kept_subject){
        .kind = passes_digest(share_digest, alone), // frames that draw load what was saved
        .inputs = inputs_digest(material, kind),
        .has_texels = has_texels(context, material, kind),
        .tile_count = count,
        .tile = shares ? share : tile,
        .map_bytes = passes_transfer_bytes(material, kind),
        .making_bytes = passes_transfer_making_bytes(material, kind),
        .makes_files_alone = alone,
        .share = shares_facets(context, index, kind) ? layout_of_share : NULL,
        .key = key,
        .user = kind,
    };
}

lobe_result passes_kept_transfer_prepare(const filter_context *context, uint32_t index,
                                         const transfer_kind *kind, void **slot) {
    const fit_work *work = context->work;
    if (!work || work->is_dry || !passes_has_relief(&context->scene->materials[index]))
        return LOBE_OK;
    const kept_subject subject = subject_of(context, index, kind);
    return subject.tile_count > 0 ? passes_kept_prepare(context, index, &subject, slot) : LOBE_OK;
}

/// What the facets of the frame's share see is all that is made.
static void build_share(const filter_context *context, uint32_t index, const transfer_kind *kind,
                        const void *prepared) {
    if (!prepared || passes_kept_is_settled(prepared, 0))
        return;
    bool in_parts;
    const uint32_t parts = passes_kept_parts(context, prepared, &in_parts);
    const relief relief = passes_relief(context, index, in_parts);
    const facet_range range = range_of_share(context, index, context->work->share);
    const facets_request request = {.graph = context->graph,
                                    .material = index,
                                    .relief = &relief,
                                    .kind = kind,
                                    .in_parts = in_parts};
    const facet_window window = {.width = relief.constants.width,
                                 .height = relief.constants.height};
    seen_facets seen = passes_facets_begin(&request, range.count);
    passes_facets_add(&request, &window, range, parts, in_parts, &seen);
    const lobe_resource buffers[] = {seen.words, seen.links, seen.basis};
    (void)passes_kept_built(context, prepared, NULL, buffers);
}

static void build_tiles(const filter_context *context, uint32_t index, const transfer_kind *kind,
                        const void *prepared) {
    if (!prepared)
        return;
    const tile_choice choice = choose_tiles(context, index, kind);
    transfer_request request = {
        .context = context, .material = index, .kind = kind, .record = prepared};
    request.parts = passes_kept_parts(context, prepared, &request.in_parts);
    const relief relief = passes_relief(context, index, request.in_parts);
    request.relief = &relief;
    passes_transfer_tiles(&request, choice.first, choice.step);
}

/// True: files are all that the frame makes.
static bool build_files(const filter_context *context, uint32_t index, const transfer_kind *kind,
                        const void *prepared) {
    if (makes_share_of_facets(context, index, kind))
        build_share(context, index, kind, prepared);
    else if (makes_tiles_alone(context, index, kind))
        build_tiles(context, index, kind, prepared);
    else
        return false;
    return true;
}

/// Whether all tiles are stored.
static bool is_stored(const filter_context *context, uint32_t index, const transfer_kind *kind,
                      const void *prepared) {
    const window_grid grid = grid_of(context, index, kind);
    bool stored = true;
    for (uint32_t i = 0; stored && i < grid.columns * grid.rows; i++)
        stored = passes_kept_stored(context, prepared, i) != NULL;
    return stored;
}

static void make(transfer_request *request, transfer_map *map) {
    const filter_context *context = request->context;
    const stored_content *joined = passes_kept_joined(context, request->record);
    if (!joined) {
        passes_transfer_map(request, map);
        return;
    }
    const seen_facets seen = {.words = lobe_graph_import_buffer(context->graph, joined->buffers[0]),
                              .links = lobe_graph_import_buffer(context->graph, joined->buffers[1]),
                              .basis =
                                  lobe_graph_import_buffer(context->graph, joined->buffers[2])};
    request->seen = &seen;
    passes_transfer_map(request, map);
}

/// Whether an earlier frame has put all that was stored into the map, and that is still there. If
/// it is lost, it is loaded again.
static bool is_placed(const filter_context *context, uint32_t index, const transfer_kind *kind,
                      const void *prepared, const transfer_map *map) {
    if (!passes_kept_is_placed(context, prepared))
        return false;
    if (!context->work->rebuilds && passes_transfer_has_content(context->graph, kind, map))
        return true;
    const kept_subject subject = subject_of(context, index, kind);
    passes_kept_reload(context, index, &subject, prepared);
    return false;
}

bool passes_kept_transfer_build(const filter_context *context, uint32_t index,
                                const transfer_kind *kind, const void *prepared, bool near,
                                transfer_map *transfer, relief *relief) {
    if (build_files(context, index, kind, prepared))
        return false;
    transfer_request request = {
        .context = context, .material = index, .kind = kind, .record = prepared};
    request.parts = passes_kept_parts(context, prepared, &request.in_parts);
    *transfer = passes_transfer_declare(context, index, kind);
    const bool placed = is_placed(context, index, kind, prepared, transfer),
               stored = placed || is_stored(context, index, kind, prepared);
    if (near || !stored) {
        *relief = passes_relief(context, index, near || request.in_parts);
        request.relief = stored ? NULL : relief;
    }
    if (placed)
        return true;
    make(&request, transfer);
    const bool whole = passes_kept_is_whole(context, prepared);
    if (whole)
        passes_kept_place(context, prepared);
    return whole;
}
