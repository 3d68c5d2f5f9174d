#ifndef THIRD_PARTY_LIBRARY_MEMORY_H
#define THIRD_PARTY_LIBRARY_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

/// Where a library takes its memory from.
typedef struct library_memory {
    /// Makes a piece larger; `memory` NULL: gives a new one. Aligned for any type. NULL without
    /// memory; the old piece is then as it was.
    void *(*resize)(void *user, void *memory, size_t size);
    void (*release)(void *memory); ///< NULL is fine
    void *user;                    ///< handed to `resize`
    bool failed;                   ///< `resize` gave NULL once; libraries say so in many ways
} library_memory;

static inline void *library_memory_resize(library_memory *memory, void *piece, size_t size) {
    void *resized = memory->resize(memory->user, piece, size);
    memory->failed = memory->failed || !resized;
    return resized;
}

#endif
