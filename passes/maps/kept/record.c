#include "passes/maps/kept/record.h"

#include "passes/context/fit_work.h"
#include "passes/maps/kept/joining.h"

/// What a frame reads back, to be saved.
typedef struct kept_reading {
    bool waits; ///< it has not been taken yet
    kept_layout layout;
    lobe_resource images[KEPT_MAXIMUM_IMAGES];
    lobe_resource buffers[KEPT_MAXIMUM_BUFFERS];
} kept_reading;

struct kept_record {
    uint64_t kind, inputs; ///< digests of what it is for
    bool changed;          ///< texels were replaced
    uint32_t part_count;
    uint32_t done; ///< parts that frames had until now, this one included
    bool in_parts; ///< what later parts need is kept between frames
    bool looked_up, settled;
    bool saved;   ///< the folder has them by now
    uint64_t key; ///< of the file, once looked up
    kept_layout layout;
    stored_content stored;
    stored_content joined; ///< of shares
    uint32_t shares;       ///< that were joined
    kept_reading *reading; ///< owned
};

// ---------------------------------------------------------------------------------------------
// Preparing

static lobe_result create(const filter_context *context, void **slot) {
    const lobe_allocator *allocator = lobe_host_allocator(context->host);
    kept_record *record = lobe_allocate(allocator, 1, sizeof *record);
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
static void update(kept_record *record, const kept_subject *subject) {
    const bool other_kind = record->kind != subject->kind;
    record->reading->waits = false;
    if (!other_kind && record->inputs == subject->inputs)
        return;
    passes_stored_content_free(&record->stored);
    passes_stored_content_free(&record->joined);
    *record = (kept_record){.kind = subject->kind,
                            .inputs = subject->inputs,
                            .changed = !other_kind,
                            .part_count = subject->parts,
                            .layout = subject->layout,
                            .reading = record->reading};
}

static bool fits_the_device(const fit_work *work, const kept_layout *layout) {
    for (uint32_t i = 0; i < layout->image_count; i++)
        if (passes_kept_rows(&layout->images[i]) > work->most_texels)
            return false;
    return true;
}

static bool joins(const fit_work *work) {
    return work->shares > 0 && work->share == 0;
}

/// They are part of the whole now.
static void remove_shares(const kept_record *record, uint32_t shares, const char *folder,
                          const lobe_host *host) {
    kept_layout layout = record->layout;
    layout.shares = shares;
    for (layout.share = 1; layout.share <= layout.shares; layout.share++)
        passes_kept_file_remove(folder, record->key, &layout, host);
}

static lobe_result join(const filter_context *context, uint32_t index, const kept_subject *subject,
                        kept_record *record) {
    record->shares = context->work->shares;
    return passes_kept_join(context, index, subject, record->key, &record->joined);
}

static lobe_result look_up(const filter_context *context, uint32_t index,
                           const kept_subject *subject, kept_record *record) {
    const fit_work *work = context->work;
    kept_content content;
    if (record->looked_up || !work->cache || record->changed || !subject->has_texels ||
        !fits_the_device(work, &subject->layout))
        return LOBE_OK;
    record->looked_up = true;
    record->key = subject->key(context, index, subject->user);
    if (record->done > 0)
        return LOBE_OK;
    if (!passes_kept_file_load(work->cache, record->key, &subject->layout, context->host, &content))
        return subject->share && joins(work) ? join(context, index, subject, record) : LOBE_OK;
    const lobe_result result =
        passes_stored_content_create(context->graph, &subject->layout, &content, &record->stored);
    passes_kept_content_free(&content);
    record->settled = result == LOBE_OK;
    if (result != LOBE_OK)
        passes_stored_content_free(&record->stored);
    else if (subject->share && joins(work)) // an earlier call may not have come to that
        remove_shares(record, work->shares, work->cache, context->host);
    return result;
}

/// Takes parts of the frame's work.
static void advance(const filter_context *context, const kept_subject *subject,
                    kept_record *record) {
    fit_work *work = context->work;
    const uint32_t left = record->part_count - record->done;
    const bool at_once = record->changed || record->stored.buffers[0] || !subject->has_texels;
    const uint32_t step = at_once || left < work->parts ? left : work->parts;
    record->in_parts = !at_once && left > 0 && (record->done > 0 || step < left);
    record->done += step;
    if (!at_once && work->parts != UINT32_MAX)
        work->parts -= step;
    work->parts_left += record->part_count - record->done;
}

static void count(fit_outcome *outcome, const kept_record *record) {
    const bool is_whole = record->done == record->part_count;
    outcome->found += record->stored.buffers[0] != NULL;
    outcome->made += record->saved;
    outcome->unsaved += is_whole && record->settled && !record->saved && !record->stored.buffers[0];
    outcome->unkept += is_whole && !record->looked_up;
}

lobe_result passes_kept_prepare(const filter_context *context, uint32_t index,
                                const kept_subject *subject, void **slot) {
    lobe_result result = *slot ? LOBE_OK : create(context, slot);
    if (result != LOBE_OK)
        return result;
    kept_record *record = *slot;
    update(record, subject);
    result = look_up(context, index, subject, record);
    if (result == LOBE_OK)
        advance(context, subject, record);
    if (result == LOBE_OK)
        count(&context->work->outcome, record);
    return result;
}

void passes_kept_forget(void *slot) {
    kept_record *record = slot;
    passes_stored_content_free(&record->stored);
    passes_stored_content_free(&record->joined);
    lobe_release(record->reading);
    lobe_release(record);
}

// ---------------------------------------------------------------------------------------------
// Building

uint32_t passes_kept_parts(const filter_context *context, const kept_record *record,
                           bool *in_parts) {
    *in_parts = record && !context->work->is_dry && record->in_parts;
    return *in_parts ? record->done : UINT32_MAX;
}

const stored_content *passes_kept_stored(const filter_context *context, const kept_record *record) {
    return record && !context->work->is_dry && record->stored.buffers[0] ? &record->stored : NULL;
}

const stored_content *passes_kept_joined(const filter_context *context, const kept_record *record) {
    return record && !context->work->is_dry && record->joined.buffers[0] ? &record->joined : NULL;
}

static void read_back(const filter_context *context, const kept_record *record,
                      const lobe_resource *images, const lobe_resource *buffers) {
    kept_reading *reading = record->reading;
    *reading = (kept_reading){.waits = true, .layout = record->layout};
    for (uint32_t i = 0; i < record->layout.image_count; i++) {
        reading->images[i] = images[i];
        lobe_graph_read_back(context->graph, images[i], (lobe_range){0});
    }
    for (uint32_t i = 0; i < record->layout.buffer_count; i++) {
        reading->buffers[i] = buffers[i];
        lobe_graph_read_back(context->graph, buffers[i], (lobe_range){0});
    }
    context->work->reads_back = true;
}

bool passes_kept_built(const filter_context *context, const kept_record *record,
                       const lobe_resource *images, const lobe_resource *buffers) {
    if (!record || context->work->is_dry)
        return true;
    const bool is_whole = record->done == record->part_count;
    if (is_whole && record->looked_up && !record->settled && context->work->saves)
        read_back(context, record, images, buffers);
    return is_whole;
}

void passes_kept_save(void *slot, const lobe_graph *graph, const char *folder,
                      const lobe_host *host) {
    kept_record *record = slot;
    kept_reading *reading = record->reading;
    if (!reading->waits)
        return;
    reading->waits = false;
    const void *images[KEPT_MAXIMUM_IMAGES] = {0}, *buffers[KEPT_MAXIMUM_BUFFERS] = {0};
    bool complete = true;
    for (uint32_t i = 0; i < reading->layout.image_count; i++) {
        images[i] = lobe_graph_data(graph, reading->images[i], NULL);
        complete &= images[i] != NULL;
    }
    for (uint32_t i = 0; i < reading->layout.buffer_count; i++) {
        buffers[i] = lobe_graph_data(graph, reading->buffers[i], NULL);
        complete &= buffers[i] != NULL;
    }
    if (!folder || !complete)
        return;
    record->saved =
        passes_kept_file_save(folder, record->key, &reading->layout, images, buffers, host);
    record->settled = true;
    if (record->saved && record->shares > 0)
        remove_shares(record, record->shares, folder, host);
}
