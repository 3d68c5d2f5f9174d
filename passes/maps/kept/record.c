#include "passes/maps/kept/record.h"

#include <string.h>

#include "passes/context/fit_work.h"
#include "passes/maps/kept/joining.h"

typedef struct tile_record {
    kept_tile tile;
    stored_content stored;
    bool found;   ///< in the folder
    bool settled; ///< found, saved, or not to be saved
    bool saved;   ///< or there, but not loaded
    bool waits;   ///< what a frame reads back of it has not been taken yet
    bool places;  ///< a frame puts what is stored into the map
    bool placed;  ///< it has done so, and nothing is stored any more
    lobe_resource images[KEPT_MAXIMUM_IMAGES];
    lobe_resource buffers[KEPT_MAXIMUM_BUFFERS];
} tile_record;

struct kept_record {
    uint64_t kind, inputs; ///< digests of what it is for
    bool changed;          ///< texels were replaced
    uint32_t done;         ///< parts that frames had until now, this one included
    bool in_parts;         ///< what later parts need is kept between frames
    bool looked_up;
    uint64_t key;          ///< of the files, once looked up
    stored_content joined; ///< of shares
    uint32_t shares;       ///< that were joined
    tile_record *tiles;    ///< owned
    uint32_t tile_count;
};

// ---------------------------------------------------------------------------------------------
// Preparing

static void free_content(kept_record *record) {
    for (uint32_t i = 0; i < record->tile_count; i++)
        passes_stored_content_free(&record->tiles[i].stored);
    passes_stored_content_free(&record->joined);
}

/// Starts again with other settings, and leaves what was stored where texels were replaced.
static lobe_result begin(const filter_context *context, uint32_t index, const kept_subject *subject,
                         kept_record *record) {
    free_content(record);
    lobe_release(record->tiles);
    *record = (kept_record){
        .kind = subject->kind, .inputs = subject->inputs, .changed = record->kind == subject->kind};
    record->tiles = lobe_allocate(lobe_host_allocator(context->host), subject->tile_count,
                                  sizeof *record->tiles);
    if (!record->tiles) {
        *record = (kept_record){0};
        return LOBE_ERROR_OUT_OF_MEMORY;
    }
    record->tile_count = subject->tile_count;
    for (uint32_t i = 0; i < record->tile_count; i++)
        record->tiles[i].tile = subject->tile(context, index, subject->user, i);
    return LOBE_OK;
}

/// What was read back and not taken is forgotten.
static lobe_result update(const filter_context *context, uint32_t index,
                          const kept_subject *subject, kept_record *record) {
    for (uint32_t i = 0; i < record->tile_count; i++)
        record->tiles[i].waits = record->tiles[i].places = false;
    return record->tiles && record->kind == subject->kind && record->inputs == subject->inputs
               ? LOBE_OK
               : begin(context, index, subject, record);
}

static bool fits_the_device(const fit_work *work, const kept_record *record) {
    for (uint32_t i = 0; i < record->tile_count; i++) {
        const kept_layout *layout = &record->tiles[i].tile.layout;
        for (uint32_t k = 0; k < layout->image_count; k++)
            if (passes_kept_rows(&layout->images[k]) > work->most_texels)
                return false;
    }
    return true;
}

static bool joins(const fit_work *work) {
    return work->shares > 0 && work->share == 0;
}

/// They are part of the whole now.
static void remove_shares(const kept_record *record, uint32_t shares, const char *folder,
                          const lobe_host *host) {
    kept_layout layout = record->tiles[0].tile.layout;
    layout.shares = shares;
    for (layout.share = 1; layout.share <= layout.shares; layout.share++)
        passes_kept_file_remove(folder, record->key, &layout, host);
}

static lobe_result join(const filter_context *context, uint32_t index, const kept_subject *subject,
                        kept_record *record) {
    record->shares = context->work->shares;
    return passes_kept_join(context, index, subject, record->key, &record->joined);
}

/// Tiles that devices made which compute differently do not fit together.
static bool fit_together(const kept_layout *layout, const kept_content *first,
                         const kept_content *content) {
    bool alike = true;
    for (uint32_t i = 0; first->file && i < layout->buffer_count; i++)
        alike &= memcmp(first->buffers[i], content->buffers[i], layout->buffer_bytes[i]) == 0;
    return alike;
}

/// The tiles that a folder has, one after the other.
typedef struct tile_search {
    const filter_context *context;
    uint32_t material;
    const kept_subject *subject;
    const kept_record *record;
    kept_content first; ///< that was found
    uint64_t room;      ///< of device memory, for tiles
    uint32_t left;      ///< tiles that were found, but not loaded
    bool again;         ///< for maps that were lost: what is settled remains so
} tile_search;

/// True: the caller frees the content.
static bool find(const tile_search *search, const tile_record *tile, kept_content *content) {
    const fit_work *work = search->context->work;
    const kept_layout *layout = &tile->tile.layout;
    const bool fails = layout->tiles > 0 && joins(work);
    const lobe_host *host = search->context->host;
    const lobe_host silent = {.allocator = lobe_host_allocator(host)};
    const char *why = NULL;
    if (!passes_kept_file_load(work->cache, search->record->key, layout, fails ? &silent : host,
                               content))
        why = "is missing or damaged";
    else if (!fit_together(layout, &search->first, content))
        why = "was made by another kind of device than the tiles before";
    if (why && fails)
        passes_kept_fail(search->context, search->material, search->record->key, layout, why);
    else if (why && content->file)
        passes_kept_file_decline(work->cache, search->record->key, layout, why, host);
    if (why)
        passes_kept_content_free(content);
    return !why;
}

/// How much device memory tiles may take: what is left of it beside the maps, and beside what makes
/// the tiles that are not there or have no room.
static uint64_t find_room(const tile_search *search) {
    const fit_work *work = search->context->work;
    const kept_record *record = search->record;
    const kept_subject *subject = search->subject;
    uint64_t bytes = 0;
    bool all = true;
    for (uint32_t i = 0; i < record->tile_count; i++) {
        const kept_layout *layout = &record->tiles[i].tile.layout;
        bytes += passes_kept_bytes(layout);
        all = all &&
              passes_kept_file_is_there(work->cache, record->key, layout, search->context->host);
    }
    if (all && subject->map_bytes + bytes <= work->free_bytes)
        return bytes;
    const uint64_t needed = subject->map_bytes + subject->making_bytes;
    return work->free_bytes > needed ? work->free_bytes - needed : 0;
}

/// Takes the memory for a tile, if there is room.
static bool take_room(tile_search *search, const kept_layout *layout) {
    const uint64_t bytes = passes_kept_bytes(layout);
    if (search->subject->makes_files_alone)
        return true;
    if (bytes > search->room)
        return false;
    search->room -= bytes;
    return true;
}

static lobe_result take(tile_search *search, tile_record *tile, kept_content *content) {
    lobe_result result = LOBE_OK;
    if (!search->subject->makes_files_alone)
        result = passes_stored_content_create(search->context->graph, &tile->tile.layout, content,
                                              &tile->stored);
    if (!search->again)
        tile->found = tile->settled = result == LOBE_OK;
    if (result != LOBE_OK)
        passes_stored_content_free(&tile->stored);
    if (result == LOBE_OK && !search->first.file)
        search->first = *content;
    else
        passes_kept_content_free(content);
    return result;
}

static void tell_of_memory(const tile_search *search) {
    const filter_context *context = search->context;
    lobe_host_log(
        context->host, LOBE_LOG_NOTICE,
        "material '%s': the device has no memory to load %u of %u cached files: what they "
        "have is made again",
        context->scene->scene->materials[search->material].name, search->left,
        search->record->tile_count);
}

/// Whether any was found.
static lobe_result find_all(tile_search *search, bool *found) {
    lobe_result result = LOBE_OK;
    const kept_record *record = search->record;
    kept_content content;
    *found = false;
    search->room = find_room(search);
    for (uint32_t i = 0; result == LOBE_OK && i < record->tile_count; i++) {
        if (!find(search, &record->tiles[i], &content))
            continue;
        *found = true;
        if (take_room(search, &record->tiles[i].tile.layout)) {
            result = take(search, &record->tiles[i], &content);
        } else {
            passes_kept_content_free(&content);
            if (!search->again)
                record->tiles[i].settled = record->tiles[i].saved = true;
            search->left++;
        }
    }
    passes_kept_content_free(&search->first);
    if (search->left > 0)
        tell_of_memory(search);
    return result;
}

static lobe_result look_up(const filter_context *context, uint32_t index,
                           const kept_subject *subject, kept_record *record) {
    const fit_work *work = context->work;
    if (record->looked_up || !work->cache || record->changed || !subject->has_texels ||
        !fits_the_device(work, record))
        return LOBE_OK;
    record->looked_up = true;
    record->key = subject->key(context, index, subject->user);
    if (record->done > 0)
        return LOBE_OK;
    tile_search search = {
        .context = context, .material = index, .subject = subject, .record = record};
    bool found;
    const lobe_result result = find_all(&search, &found);
    if (result != LOBE_OK || !subject->share || !joins(work))
        return result;
    if (!found)
        return join(context, index, subject, record);
    remove_shares(record, work->shares, work->cache, context->host); // an earlier call may have
    return LOBE_OK;                                                  // failed before that
}

uint32_t passes_kept_tile_parts(const kept_record *record, uint32_t tile) {
    return record->tiles[tile].found ? 0 : record->tiles[tile].tile.parts;
}

static uint32_t parts_until(const kept_record *record, uint32_t tile_count) {
    uint32_t parts = 0;
    for (uint32_t i = 0; i < tile_count; i++)
        parts += passes_kept_tile_parts(record, i);
    return parts;
}

static uint32_t parts_left(const kept_record *record) {
    return parts_until(record, record->tile_count) - record->done;
}

/// Takes parts of the frame's work.
static void advance(const filter_context *context, const kept_subject *subject,
                    kept_record *record) {
    fit_work *work = context->work;
    const uint32_t left = parts_left(record);
    const bool at_once = record->changed || !subject->has_texels;
    const uint32_t step = at_once || left < work->parts ? left : work->parts;
    record->in_parts = !at_once && left > 0 && (record->done > 0 || step < left);
    record->done += step;
    if (!at_once && work->parts != UINT32_MAX)
        work->parts -= step;
    work->parts_left += parts_left(record);
}

static void count(fit_outcome *outcome, const kept_record *record) {
    uint32_t found = 0, saved = 0, settled = 0;
    for (uint32_t i = 0; i < record->tile_count; i++) {
        found += record->tiles[i].found;
        saved += record->tiles[i].saved;
        settled += record->tiles[i].settled;
    }
    outcome->found += found == record->tile_count;
    outcome->made += saved > 0 && found + saved == record->tile_count;
    outcome->unsaved += parts_left(record) == 0 && settled > found + saved;
    outcome->unkept += parts_left(record) == 0 && !record->looked_up;
}

lobe_result passes_kept_prepare(const filter_context *context, uint32_t index,
                                const kept_subject *subject, void **slot) {
    if (!*slot)
        *slot = lobe_allocate(lobe_host_allocator(context->host), 1, sizeof(kept_record));
    kept_record *record = *slot;
    lobe_result result =
        record ? update(context, index, subject, record) : LOBE_ERROR_OUT_OF_MEMORY;
    if (result == LOBE_OK)
        result = look_up(context, index, subject, record);
    if (result != LOBE_OK)
        return result;
    advance(context, subject, record);
    count(&context->work->outcome, record);
    return LOBE_OK;
}

void passes_kept_forget(void *slot) {
    kept_record *record = slot;
    free_content(record);
    lobe_release(record->tiles);
    lobe_release(record);
}

// ---------------------------------------------------------------------------------------------
// Building

uint32_t passes_kept_parts(const filter_context *context, const kept_record *record,
                           bool *in_parts) {
    *in_parts = record && !context->work->is_dry && record->in_parts;
    return *in_parts ? record->done : UINT32_MAX;
}

const stored_content *passes_kept_stored(const filter_context *context, const kept_record *record,
                                         uint32_t tile) {
    return record && !context->work->is_dry && record->tiles[tile].stored.buffers[0]
               ? &record->tiles[tile].stored
               : NULL;
}

/// What a rebuilding frame has placed will be needed in the next one.
void passes_kept_place(const filter_context *context, const kept_record *record) {
    fit_work *work = context->work;
    if (!record || work->is_dry || !work->saves || work->rebuilds)
        return;
    for (uint32_t i = 0; i < record->tile_count; i++)
        if (record->tiles[i].stored.buffers[0])
            record->tiles[i].places = work->reads_back = true;
}

bool passes_kept_is_placed(const filter_context *context, const kept_record *record) {
    bool placed = false;
    for (uint32_t i = 0; record && !context->work->is_dry && i < record->tile_count; i++)
        placed = placed || record->tiles[i].placed;
    return placed;
}

/// What is no longer in the folder is made again at once, and not saved.
void passes_kept_reload(const filter_context *context, uint32_t material,
                        const kept_subject *subject, const kept_record *record) {
    tile_search search = {.context = context,
                          .material = material,
                          .subject = subject,
                          .record = record,
                          .again = true};
    bool found;
    for (uint32_t i = 0; i < record->tile_count; i++)
        record->tiles[i].placed = false;
    const lobe_result result = context->work->cache ? find_all(&search, &found) : LOBE_OK;
    if (result != LOBE_OK)
        lobe_graph_fail(context->graph, result, "filter '%s', material '%s': %s",
                        context->filter->name, context->scene->scene->materials[material].name,
                        lobe_result_message(result));
}

bool passes_kept_is_settled(const kept_record *record, uint32_t tile) {
    return record->tiles[tile].settled;
}

const stored_content *passes_kept_joined(const filter_context *context, const kept_record *record) {
    return record && !context->work->is_dry && record->joined.buffers[0] ? &record->joined : NULL;
}

bool passes_kept_wants(const filter_context *context, const kept_record *record, uint32_t tile) {
    return record && !context->work->is_dry && record->looked_up && context->work->saves &&
           !record->tiles[tile].settled && record->done >= parts_until(record, tile + 1);
}

void passes_kept_read_back(const filter_context *context, const kept_record *record, uint32_t index,
                           const lobe_resource *images, const lobe_resource *buffers) {
    tile_record *tile = &record->tiles[index];
    const kept_layout *layout = &tile->tile.layout;
    for (uint32_t i = 0; i < layout->image_count; i++) {
        tile->images[i] = images[i];
        lobe_graph_read_back(context->graph, images[i],
                             (lobe_range){.level_count = layout->images[i].levels});
    }
    for (uint32_t i = 0; i < layout->buffer_count; i++) {
        tile->buffers[i] = buffers[i];
        lobe_graph_read_back(context->graph, buffers[i], (lobe_range){0});
    }
    tile->waits = context->work->reads_back = true;
}

bool passes_kept_is_whole(const filter_context *context, const kept_record *record) {
    return !record || context->work->is_dry || parts_left(record) == 0;
}

bool passes_kept_built(const filter_context *context, const kept_record *record,
                       const lobe_resource *images, const lobe_resource *buffers) {
    if (passes_kept_wants(context, record, 0))
        passes_kept_read_back(context, record, 0, images, buffers);
    return passes_kept_is_whole(context, record);
}

// ---------------------------------------------------------------------------------------------
// Saving

/// False: the frame has not come to that.
static bool get_content(const tile_record *tile, const lobe_graph *graph, const void **images,
                        const void **buffers) {
    bool complete = true;
    for (uint32_t i = 0; i < tile->tile.layout.image_count; i++) {
        images[i] = lobe_graph_data(graph, tile->images[i], NULL);
        complete &= images[i] != NULL;
    }
    for (uint32_t i = 0; i < tile->tile.layout.buffer_count; i++) {
        buffers[i] = lobe_graph_data(graph, tile->buffers[i], NULL);
        complete &= buffers[i] != NULL;
    }
    return complete;
}

/// One failure is told of: the tiles that follow are not tried.
static void give_up(kept_record *record) {
    for (uint32_t i = 0; i < record->tile_count; i++)
        record->tiles[i].settled = true;
}

/// Whether the frame had a use for what it placed: maps of a frame that draws nothing are declared
/// only.
static bool has_placed(const lobe_graph *graph) {
    const lobe_graph_report *report = lobe_graph_describe(graph);
    bool placed = true;
    for (size_t i = 0; i < report->pass_count; i++)
        placed = placed && (report->passes[i].state != LOBE_PASS_CULLED ||
                            strcmp(report->passes[i].name, PASSES_RESTORING) != 0);
    return placed;
}

static void free_placed(kept_record *record, const lobe_graph *graph) {
    const bool placed = has_placed(graph);
    for (uint32_t i = 0; i < record->tile_count; i++) {
        tile_record *tile = &record->tiles[i];
        if (tile->places && placed) {
            passes_stored_content_free(&tile->stored);
            tile->placed = true;
        }
        tile->places = false;
    }
}

void passes_kept_save(void *slot, const lobe_graph *graph, const char *folder,
                      const lobe_host *host) {
    kept_record *record = slot;
    free_placed(record, graph);
    for (uint32_t i = 0; i < record->tile_count; i++) {
        tile_record *tile = &record->tiles[i];
        const void *images[KEPT_MAXIMUM_IMAGES] = {0}, *buffers[KEPT_MAXIMUM_BUFFERS] = {0};
        const bool waits = tile->waits;
        tile->waits = false;
        if (!waits || tile->settled || !folder || !get_content(tile, graph, images, buffers))
            continue;
        tile->saved =
            passes_kept_file_save(folder, record->key, &tile->tile.layout, images, buffers, host);
        tile->settled = true;
        if (!tile->saved)
            give_up(record);
        else if (record->shares > 0)
            remove_shares(record, record->shares, folder, host);
    }
}
