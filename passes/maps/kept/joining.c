#include "passes/maps/kept/joining.h"

#include <string.h>

#include "passes/context/fit_work.h"

void passes_kept_fail(const filter_context *context, uint32_t material, uint64_t key,
                      const kept_layout *layout, const char *why) {
    const uint32_t shares = context->work->shares,
                   share = layout->tiles > 0 ? (layout->tile - 1) % shares + 1 : layout->share;
    char *path = passes_kept_file_path(context->work->cache, key, layout, context->host);
    lobe_graph_fail(context->graph, LOBE_ERROR_NOT_FOUND, "%s: part %u of %u of material '%s' %s",
                    path ? path : context->work->cache, share, shares,
                    context->scene->scene->materials[material].name, why);
    lobe_release(path);
}

typedef struct joining {
    const filter_context *context;
    uint32_t material;
    kept_layout whole; ///< of the buffers joined; no images
    uint8_t *buffers[KEPT_MAXIMUM_BUFFERS];
    size_t filled[KEPT_MAXIMUM_BUFFERS]; ///< bytes
} joining;

/// All but the last buffer grow with each share.
static void add_size(joining *joining, const kept_layout *share) {
    kept_layout *whole = &joining->whole;
    whole->buffer_count = share->buffer_count;
    for (uint32_t i = 0; i < share->buffer_count; i++)
        whole->buffer_bytes[i] =
            share->buffer_bytes[i] + (i + 1 < share->buffer_count ? whole->buffer_bytes[i] : 0);
}

static lobe_result allocate(joining *joining) {
    const lobe_allocator *allocator = lobe_host_allocator(joining->context->host);
    for (uint32_t i = 0; i < joining->whole.buffer_count; i++) {
        joining->buffers[i] = lobe_allocate(allocator, joining->whole.buffer_bytes[i], 1);
        if (!joining->buffers[i])
            return LOBE_ERROR_OUT_OF_MEMORY;
    }
    return LOBE_OK;
}

/// False: the last buffer is not that of the shares before.
static bool append(joining *joining, const kept_layout *share, const kept_content *content) {
    const uint32_t last = share->buffer_count - 1;
    for (uint32_t i = 0; i < last; i++) {
        memcpy(joining->buffers[i] + joining->filled[i], content->buffers[i],
               share->buffer_bytes[i]);
        joining->filled[i] += share->buffer_bytes[i];
    }
    const bool is_first = joining->filled[last] == 0;
    if (is_first)
        memcpy(joining->buffers[last], content->buffers[last], share->buffer_bytes[last]);
    joining->filled[last] = share->buffer_bytes[last];
    return is_first ||
           memcmp(joining->buffers[last], content->buffers[last], share->buffer_bytes[last]) == 0;
}

/// False: the frame has failed.
static bool load_share(joining *joining, uint64_t key, const kept_layout *share) {
    const filter_context *context = joining->context;
    const lobe_host silent = {.allocator = lobe_host_allocator(context->host)};
    kept_content content;
    if (!passes_kept_file_load(context->work->cache, key, share, &silent, &content)) {
        passes_kept_fail(context, joining->material, key, share, "is missing or damaged");
        return false;
    }
    const bool belongs = append(joining, share, &content);
    passes_kept_content_free(&content);
    if (!belongs)
        passes_kept_fail(context, joining->material, key, share,
                         "was made by another kind of device than the parts before");
    return belongs;
}

lobe_result passes_kept_join(const filter_context *context, uint32_t index,
                             const kept_subject *subject, uint64_t key, stored_content *joined) {
    const uint32_t shares = context->work->shares;
    joining joining = {.context = context, .material = index};
    for (uint32_t share = 1; share <= shares; share++) {
        const kept_layout layout = subject->share(context, index, subject->user, share);
        if (layout.buffer_count > 0)
            add_size(&joining, &layout);
    }
    lobe_result result = allocate(&joining);
    bool complete = result == LOBE_OK;
    for (uint32_t share = 1; complete && share <= shares; share++) {
        const kept_layout layout = subject->share(context, index, subject->user, share);
        complete = layout.buffer_count == 0 || load_share(&joining, key, &layout);
    }
    kept_content content = {0};
    for (uint32_t i = 0; i < joining.whole.buffer_count; i++)
        content.buffers[i] = joining.buffers[i];
    if (complete)
        result = passes_stored_content_create(context->graph, &joining.whole, &content, joined);
    if (result != LOBE_OK)
        passes_stored_content_free(joined);
    for (uint32_t i = 0; i < joining.whole.buffer_count; i++)
        lobe_release(joining.buffers[i]);
    return result;
}
