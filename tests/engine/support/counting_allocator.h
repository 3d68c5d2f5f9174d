#ifndef TESTS_ENGINE_SUPPORT_COUNTING_ALLOCATOR_H
#define TESTS_ENGINE_SUPPORT_COUNTING_ALLOCATOR_H

#include <stdatomic.h>
#include <stddef.h>

#include <lobe/host.h>

/// A host's allocator that counts its blocks, and fails on demand.
typedef struct counting_allocator {
    lobe_allocator allocator;     ///< pass this to lobe
    _Atomic size_t blocks, bytes; ///< allocated and not freed
    _Atomic size_t taken;         ///< allocations so far; set to 0 to restart
    _Atomic size_t mistakes;      ///< frees of foreign blocks, or with the wrong size
    size_t failing;               ///< the allocation that fails; 0: none
} counting_allocator;

/// Starts or restarts; the structure must not be moved.
void counting_allocator_start(counting_allocator *counting);

/// Asserts that everything was freed, with the right sizes.
void assert_nothing_left(const counting_allocator *counting);

/// Work that allocates with the allocator of `host` and frees everything in the end. Returns the
/// first failure.
typedef lobe_result (*counted_work)(void *user, const lobe_host *host);

/// Does the work once, then once more for each of its allocations, which then fails. Asserts that
/// the work returns the error, logs one line and frees everything each time. Returns the number of
/// allocations.
size_t fail_each_allocation(counted_work work, void *user);

#endif
