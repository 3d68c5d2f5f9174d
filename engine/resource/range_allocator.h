#ifndef ENGINE_RESOURCE_RANGE_ALLOCATOR_H
#define ENGINE_RESOURCE_RANGE_ALLOCATOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/allocator.h>

/// Allocates ranges of [0, size), in any unit.
typedef struct engine_range {
    uint64_t offset, size;
} engine_range;

typedef struct engine_range_allocator {
    engine_range *free; ///< ordered, never adjacent, never empty
    size_t free_count, free_capacity;
    size_t taken_count; ///< ranges handed out
    uint64_t size;
} engine_range_allocator;

/// False if out of memory.
bool engine_range_allocator_create(const lobe_allocator *host, uint64_t size,
                                   engine_range_allocator *allocator);
void engine_range_allocator_destroy(engine_range_allocator *allocator);

/// Reserves host memory so that taking the next range cannot fail for lack of it. False if out of
/// memory.
bool engine_range_reserve(engine_range_allocator *allocator);

/// Takes `size` > 0 at a multiple of `alignment` (a power of two) from the best-fitting free range.
/// False, with nothing changed, if none is large enough or host memory runs out.
bool engine_range_allocate(engine_range_allocator *allocator, uint64_t size, uint64_t alignment,
                           uint64_t *offset);

/// Gives back exactly what was taken. Cannot fail.
void engine_range_free(engine_range_allocator *allocator, uint64_t offset, uint64_t size);

#endif
