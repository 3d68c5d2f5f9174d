#ifndef TESTS_ENGINE_SUPPORT_COUNTING_ALLOCATOR_H
#define TESTS_ENGINE_SUPPORT_COUNTING_ALLOCATOR_H

#include <stdatomic.h>
#include <stddef.h>

#include <lobe/host.h>

/// A host's allocator that keeps the books, and fails when it is told to.
typedef struct counting_allocator {
    lobe_allocator allocator;     ///< hand this to lobe
    _Atomic size_t blocks, bytes; ///< taken and not given back
    _Atomic size_t taken;         ///< calls so far; set to 0 to count anew
    _Atomic size_t mistakes;      ///< blocks of somebody else, or given back as of another size
    size_t failing;               ///< the call that gets nothing; 0: none
} counting_allocator;

/// Starts or restarts; it must stay where it is.
void counting_allocator_start(counting_allocator *counting);

/// Asserts that all has come back, as it was taken.
void assert_nothing_left(const counting_allocator *counting);

/// Something to do with memory of the log's allocator, which is all given back in the end. Returns
/// the first failure.
typedef lobe_result (*counted_work)(void *user, const lobe_host *host);

/// Does it once with as much memory as it likes, then once for each time that it asked for some,
/// which then fails. Asserts that it says so by its code and one line each time, and gives back all
/// that it got. Returns how often it asked.
size_t fail_each_allocation(counted_work work, void *user);

#endif
