#include "tests/engine/support/counting_allocator.h"

#include "tests/engine/support/cmocka_all.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "tests/engine/support/log_recorder.h"

/// Precedes each block.
typedef struct block_label {
    alignas(16) const counting_allocator *owner;
    size_t size;
} block_label;

static void *allocate(void *user, size_t size) {
    counting_allocator *counting = user;
    if (++counting->taken == counting->failing)
        return NULL;
    block_label *label = malloc(sizeof *label + size);
    if (!label)
        return NULL;
    *label = (block_label){counting, size};
    counting->blocks++;
    counting->bytes += size;
    counting->mistakes += size == 0;
    // Callers must not depend on the previous content.
    return memset(label + 1, 0xa5, size);
}

static void release(void *user, void *memory, size_t size) {
    counting_allocator *counting = user;
    block_label *label = (block_label *)memory - 1;
    counting->mistakes += label->owner != counting || label->size != size;
    counting->blocks--;
    counting->bytes -= label->size;
    label->owner = NULL;
    free(label);
}

void counting_allocator_start(counting_allocator *counting) {
    *counting = (counting_allocator){
        .allocator = {.allocate = allocate, .release = release, .user = counting}};
}

void assert_nothing_left(const counting_allocator *counting) {
    if (counting->blocks || counting->bytes || counting->mistakes)
        fail_msg("%zu blocks of %zu bytes are left, %zu mistakes were made", counting->blocks,
                 counting->bytes, counting->mistakes);
}

static void work_with_failure(counted_work work, void *user, counting_allocator *counting,
                              size_t failing) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    counting_allocator_start(counting);
    recorder.host.allocator = &counting->allocator;
    counting->failing = failing;
    const lobe_result result = work(user, &recorder.host);
    const lobe_result expected = failing ? LOBE_ERROR_OUT_OF_MEMORY : LOBE_OK;
    if (result != expected || recorder.errors != (failing > 0))
        fail_msg("allocation %zu: %s, %d lines, the last '%s'", failing, lobe_result_name(result),
                 recorder.errors, recorder.last_error);
    assert_nothing_left(counting);
}

size_t fail_each_allocation(counted_work work, void *user) {
    counting_allocator counting;
    work_with_failure(work, user, &counting, 0);
    const size_t count = counting.taken;
    for (size_t failing = 1; failing <= count; failing++)
        work_with_failure(work, user, &counting, failing);
    return count;
}
