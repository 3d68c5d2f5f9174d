#ifndef ENGINE_BASE_SORT_H
#define ENGINE_BASE_SORT_H

#include <stddef.h>
#include <stdint.h>

static inline void engine_sort_swap(unsigned char *first, unsigned char *second, size_t size) {
    for (size_t i = 0; i < size; i++) {
        unsigned char held = first[i];
        first[i] = second[i];
        second[i] = held;
    }
}

/// Like qsort, but never allocates; fast if most items are already in order. Equal items may change
/// places.
///
/// Only for what the render graph sorts in every frame (graph/plan): a frame like the last
/// allocates no host memory, but qsort of glibc calls malloc for more than 1 KiB of items.
/// Elsewhere, use qsort.
///
/// Shell 1959, "A high-speed sorting procedure"; gaps: Knuth 1973, "The art of computer
/// programming 3", section 5.2.1, (3^k - 1) / 2.
static inline void engine_sort(void *items, uint32_t count, size_t size,
                               int (*compare)(const void *, const void *)) {
    unsigned char *bytes = items;
    size_t gap = 1;
    while (gap < count / 3)
        gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (size_t i = gap; i < count; i++)
            for (size_t j = i; j >= gap && compare(bytes + (j - gap) * size, bytes + j * size) > 0;
                 j -= gap)
                engine_sort_swap(bytes + (j - gap) * size, bytes + j * size, size);
}

#endif
