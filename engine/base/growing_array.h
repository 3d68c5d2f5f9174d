#ifndef ENGINE_BASE_GROWING_ARRAY_H
#define ENGINE_BASE_GROWING_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/allocator.h>

/// Makes room for `needed` items of `size` bytes by doubling the capacity; keeps the items. False
/// if out of memory.
static inline bool engine_array_reserve(const lobe_allocator *allocator, void **items,
                                        uint32_t *capacity, uint64_t needed, size_t size) {
    if (needed <= *capacity)
        return true;
    uint64_t grown = *capacity ? *capacity : 8;
    while (grown < needed)
        grown *= 2;
    if (grown > UINT32_MAX)
        return false;
    void *moved = lobe_reallocate(allocator, *items, (size_t)grown, size);
    if (!moved)
        return false;
    *items = moved;
    *capacity = (uint32_t)grown;
    return true;
}

#endif
