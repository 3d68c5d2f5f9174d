#include "engine/resource/range_allocator.h"

#include <stdlib.h>
#include <string.h>

bool engine_range_allocator_create(const lobe_allocator *host, uint64_t size,
                                   engine_range_allocator *allocator) {
    *allocator = (engine_range_allocator){.size = size, .free_capacity = 8};
    allocator->free = lobe_allocate(host, allocator->free_capacity, sizeof *allocator->free);
    if (!allocator->free)
        return false;
    allocator->free[allocator->free_count++] = (engine_range){0, size};
    return true;
}

void engine_range_allocator_destroy(engine_range_allocator *allocator) {
    lobe_release(allocator->free);
    *allocator = (engine_range_allocator){0};
}

static uint64_t align_up(uint64_t value, uint64_t alignment) {
    return (value + alignment - 1) & ~(alignment - 1);
}

static bool fits(engine_range range, uint64_t size, uint64_t alignment) {
    const uint64_t padding = align_up(range.offset, alignment) - range.offset;
    return padding <= range.size && size <= range.size - padding;
}

static bool reserve(engine_range_allocator *allocator, size_t count) {
    if (count <= allocator->free_capacity)
        return true;
    const size_t capacity = 2 * count;
    engine_range *ranges = lobe_reallocate(NULL, allocator->free, capacity, sizeof *ranges);
    if (!ranges)
        return false;
    allocator->free = ranges;
    allocator->free_capacity = capacity;
    return true;
}

static void insert(engine_range_allocator *allocator, size_t index, engine_range range) {
    memmove(&allocator->free[index + 1], &allocator->free[index],
            (allocator->free_count - index) * sizeof *allocator->free);
    allocator->free[index] = range;
    allocator->free_count++;
}

static void remove_at(engine_range_allocator *allocator, size_t index) {
    allocator->free_count--;
    memmove(&allocator->free[index], &allocator->free[index + 1],
            (allocator->free_count - index) * sizeof *allocator->free);
}

static size_t best_fit(const engine_range_allocator *allocator, uint64_t size, uint64_t alignment) {
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < allocator->free_count; i++)
        if (fits(allocator->free[i], size, alignment) &&
            (best == SIZE_MAX || allocator->free[i].size < allocator->free[best].size))
            best = i;
    return best;
}

bool engine_range_reserve(engine_range_allocator *allocator) {
    // n taken ranges leave at most n + 1 free ones between them, and one more temporarily while
    // a range is freed: reserve them now, so that freeing never needs memory.
    return reserve(allocator, allocator->taken_count + 3);
}

bool engine_range_allocate(engine_range_allocator *allocator, uint64_t size, uint64_t alignment,
                           uint64_t *offset) {
    const size_t index = best_fit(allocator, size, alignment);
    if (index == SIZE_MAX || !engine_range_reserve(allocator))
        return false;
    const engine_range range = allocator->free[index];
    const uint64_t start = align_up(range.offset, alignment);
    const engine_range before = {range.offset, start - range.offset};
    const engine_range after = {start + size, range.size - before.size - size};
    remove_at(allocator, index);
    if (after.size)
        insert(allocator, index, after);
    if (before.size)
        insert(allocator, index, before);
    allocator->taken_count++;
    *offset = start;
    return true;
}

static bool touches(engine_range first, engine_range second) {
    return first.offset + first.size == second.offset;
}

void engine_range_free(engine_range_allocator *allocator, uint64_t offset, uint64_t size) {
    size_t index = 0;
    while (index < allocator->free_count && allocator->free[index].offset < offset)
        index++;
    insert(allocator, index, (engine_range){offset, size});
    allocator->taken_count--;
    engine_range *ranges = allocator->free;
    if (index + 1 < allocator->free_count && touches(ranges[index], ranges[index + 1])) {
        ranges[index].size += ranges[index + 1].size;
        remove_at(allocator, index + 1);
    }
    if (index > 0 && touches(ranges[index - 1], ranges[index])) {
        ranges[index - 1].size += ranges[index].size;
        remove_at(allocator, index);
    }
}
