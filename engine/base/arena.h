#ifndef ENGINE_BASE_ARENA_H
#define ENGINE_BASE_ARENA_H

#include <stddef.h>

#include <lobe/allocator.h>

/// Host memory for things that are forgotten all at once. All zero: empty.
typedef struct engine_arena {
    const lobe_allocator *allocator; ///< where chunks come from; set before the first use
    struct engine_arena_chunk *chunks;
} engine_arena;

/// Zeroed bytes, aligned for any type; NULL without memory.
void *engine_arena_allocate(engine_arena *arena, size_t size);
/// NULL without memory. A size of 0 gives a valid pointer.
void *engine_arena_copy(engine_arena *arena, const void *data, size_t size);
char *engine_arena_copy_text(engine_arena *arena, const char *text);
/// Forgets all; keeps the largest chunk for what comes next.
void engine_arena_reset(engine_arena *arena);
void engine_arena_free(engine_arena *arena);

#endif
