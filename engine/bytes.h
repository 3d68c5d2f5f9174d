#ifndef ENGINE_BYTES_H
#define ENGINE_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// A growing block of memory that libraries write a file into. All zero: empty.
typedef struct engine_bytes {
    uint8_t *data;
    size_t size, capacity;
} engine_bytes;

/// Writes at `offset`, which may lie before or behind the end; a gap is filled with zeroes.
/// False without memory, then nothing has changed.
bool engine_bytes_write(engine_bytes *bytes, size_t offset, const void *data, size_t size);

/// Frees the memory and zeroes the structure.
void engine_bytes_free(engine_bytes *bytes);

#endif
