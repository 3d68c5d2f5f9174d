#ifndef ENGINE_BASE_BYTES_H
#define ENGINE_BASE_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/allocator.h>

/// A growing block of memory that libraries write a file into. All zero: empty.
typedef struct engine_bytes {
    const lobe_allocator *allocator;
    uint8_t *data; ///< of lobe_allocate
    size_t size, capacity;
} engine_bytes;

/// Makes room for `size` bytes, which are not counted yet. False without memory.
bool engine_bytes_reserve(engine_bytes *bytes, size_t size);

/// Writes at `offset`, which may lie before or behind the end; a gap is filled with zeroes.
/// False without memory, then nothing has changed.
bool engine_bytes_write(engine_bytes *bytes, size_t offset, const void *data, size_t size);

/// Frees the memory: it is empty again.
void engine_bytes_free(engine_bytes *bytes);

#endif
