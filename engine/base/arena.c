#include "engine/base/arena.h"

#include <stdalign.h>
#include <stdint.h>
#include <string.h>

#define FIRST_CHUNK_SIZE ((size_t)16 << 10)

typedef struct engine_arena_chunk {
    struct engine_arena_chunk *next;
    size_t size, used; ///< bytes of `bytes`
    alignas(max_align_t) unsigned char bytes[];
} engine_arena_chunk;

static engine_arena_chunk *add_chunk(engine_arena *arena, size_t needed) {
    size_t size = arena->chunks ? 2 * arena->chunks->size : FIRST_CHUNK_SIZE;
    while (size < needed)
        size *= 2;
    engine_arena_chunk *chunk = lobe_allocate(arena->allocator, 1, sizeof *chunk + size);
    if (!chunk)
        return NULL;
    *chunk = (engine_arena_chunk){.next = arena->chunks, .size = size};
    arena->chunks = chunk;
    return chunk;
}

void *engine_arena_allocate(engine_arena *arena, size_t size) {
    const size_t alignment = alignof(max_align_t);
    if (size > SIZE_MAX / 4)
        return NULL;
    size = (size + alignment) / alignment * alignment;
    engine_arena_chunk *chunk = arena->chunks;
    if (!chunk || chunk->size - chunk->used < size)
        chunk = add_chunk(arena, size);
    if (!chunk)
        return NULL;
    void *bytes = chunk->bytes + chunk->used;
    chunk->used += size;
    return memset(bytes, 0, size);
}

void *engine_arena_copy(engine_arena *arena, const void *data, size_t size) {
    void *copy = engine_arena_allocate(arena, size);
    if (copy && size > 0)
        memcpy(copy, data, size);
    return copy;
}

char *engine_arena_copy_text(engine_arena *arena, const char *text) {
    return engine_arena_copy(arena, text, strlen(text) + 1);
}

static void free_chunks(engine_arena_chunk *chunk) {
    while (chunk) {
        engine_arena_chunk *next = chunk->next;
        lobe_release(chunk);
        chunk = next;
    }
}

void engine_arena_reset(engine_arena *arena) {
    if (!arena->chunks)
        return;
    // Chunks double in size: the newest is the largest.
    free_chunks(arena->chunks->next);
    arena->chunks->next = NULL;
    arena->chunks->used = 0;
}

void engine_arena_free(engine_arena *arena) {
    free_chunks(arena->chunks);
    arena->chunks = NULL;
}
