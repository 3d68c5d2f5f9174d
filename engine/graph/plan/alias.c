#include "engine/graph/plan/alias.h"

#include <stdlib.h>

static uint64_t align_up(uint64_t value, uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

/// Larger first; equal sizes in order of declaration, so that the plan is deterministic.
static int compare_requests(const void *a, const void *b) {
    const engine_alias_request *first = *(engine_alias_request *const *)a;
    const engine_alias_request *second = *(engine_alias_request *const *)b;
    if (first->size != second->size)
        return first->size > second->size ? -1 : 1;
    return first < second ? -1 : first > second;
}

static int compare_offsets(const void *a, const void *b) {
    const engine_alias_request *first = *(engine_alias_request *const *)a;
    const engine_alias_request *second = *(engine_alias_request *const *)b;
    return first->offset < second->offset ? -1 : first->offset > second->offset;
}

static bool alive_together(const engine_alias_request *a, const engine_alias_request *b) {
    return a->first <= b->last && b->first <= a->last;
}

/// `placed`: the requests that are placed already and alive together with this one.
static void place(engine_alias_request *request, engine_alias_request **placed, size_t count) {
    qsort(placed, count, sizeof *placed, compare_offsets);
    uint64_t offset = 0;
    for (size_t i = 0; i < count; i++) {
        if (offset + request->size <= placed[i]->offset)
            break;
        uint64_t end = placed[i]->offset + placed[i]->size;
        if (end > offset)
            offset = align_up(end, request->alignment);
    }
    request->offset = offset;
}

bool engine_alias_plan(const lobe_allocator *allocator, engine_alias_request *requests,
                       size_t count, uint64_t *shared_size, uint64_t *separate_size) {
    *shared_size = *separate_size = 0;
    engine_alias_request **order = lobe_allocate(allocator, 2 * count + 1, sizeof *order);
    if (!order)
        return false;
    engine_alias_request **alive = order + count;
    for (size_t i = 0; i < count; i++)
        order[i] = &requests[i];
    if (count > 0)
        qsort(order, count, sizeof *order, compare_requests);
    for (size_t i = 0; i < count; i++) {
        engine_alias_request *request = order[i];
        size_t alive_count = 0;
        for (size_t j = 0; j < i; j++)
            if (alive_together(request, order[j]))
                alive[alive_count++] = order[j];
        place(request, alive, alive_count);
        uint64_t end = request->offset + request->size;
        *shared_size = end > *shared_size ? end : *shared_size;
        *separate_size = align_up(*separate_size, request->alignment) + request->size;
    }
    lobe_release(order);
    return true;
}
