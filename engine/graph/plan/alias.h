#ifndef ENGINE_GRAPH_PLAN_ALIAS_H
#define ENGINE_GRAPH_PLAN_ALIAS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/allocator.h>

/// Something that needs memory from position `first` to position `last`, both included.
typedef struct engine_alias_request {
    uint64_t size;      ///< bytes, above 0
    uint64_t alignment; ///< bytes, above 0
    uint32_t first, last;
    uint64_t offset; ///< result: bytes from the start of the shared block
} engine_alias_request;

/// Places all requests into one block so that those alive together never overlap. Largest first,
/// each at the lowest offset that is free during its life.
///
/// `shared_size` is the block's size, `separate_size` what it would be if nothing shared memory;
/// the first is never above the second. False without host memory.
bool engine_alias_plan(const lobe_allocator *allocator, engine_alias_request *requests,
                       size_t count, uint64_t *shared_size, uint64_t *separate_size);

#endif
