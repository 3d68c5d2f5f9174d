#ifndef ENGINE_BASE_ARENA_H
#define ENGINE_BASE_ARENA_H

#include <stddef.h>

#include <lobe/allocator.h>

/// Host memory for things that are freed all at once. All zero: empty.
typedef struct engine_arena {
    const lobe_allocator *allocator; ///< where chunks come from; set before the first use
    struct engine_arena_chunk *chunks;
} engine_arena;

/// Returns zeroed bytes, aligned for any type; NULL if out of memory.
void *engine_arena_allocate(engine_arena *arena, size_t size);
/// NULL if out of memory. A size of 0 returns a valid pointer.
void *engine_arena_copy(engine_arena *arena, const void *data, size_t size);
char *engine_arena_copy_text(engine_arena *arena, const char *text);
/// Frees everything; keeps the largest chunk for reuse.
void engine_arena_reset(engine_arena *arena);
void engine_arena_free(engine_arena *arena);

#endif
