#ifndef THIRD_PARTY_LIBRARY_MEMORY_H
#define THIRD_PARTY_LIBRARY_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

/// The allocator that a library uses.
typedef struct library_memory {
    /// Like realloc: resizes a block, or allocates one if `memory` is NULL. Aligned for any type.
    /// NULL if out of memory; the old block is then unchanged.
    void *(*resize)(void *user, void *memory, size_t size);
    void (*release)(void *memory); ///< NULL is allowed
    void *user;                    ///< handed to `resize`
    bool failed; ///< `resize` returned NULL; libraries report this in various ways
} library_memory;

static inline void *library_memory_resize(library_memory *memory, void *piece, size_t size) {
    void *resized = memory->resize(memory->user, piece, size);
    memory->failed = memory->failed || !resized;
    return resized;
}

#endif
