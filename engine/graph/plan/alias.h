#ifndef ENGINE_GRAPH_PLAN_ALIAS_H
#define ENGINE_GRAPH_PLAN_ALIAS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/allocator.h>

/// A request for memory from position `first` to position `last`, inclusive.
typedef struct engine_alias_request {
    uint64_t size;      ///< bytes, above 0
    uint64_t alignment; ///< bytes, above 0
    uint32_t first, last;
    uint64_t offset; ///< result: bytes from the start of the shared block
} engine_alias_request;

/// Places all requests in one block so that requests alive at the same position never overlap:
/// largest first, each at the lowest offset that is free during its lifetime.
///
/// `shared_size` is the size of the block, `separate_size` its size if nothing shared memory, which
/// is never smaller. False if out of host memory.
bool engine_alias_plan(const lobe_allocator *allocator, engine_alias_request *requests,
                       size_t count, uint64_t *shared_size, uint64_t *separate_size);

#endif
