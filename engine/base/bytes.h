#ifndef ENGINE_BASE_BYTES_H
#define ENGINE_BASE_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/allocator.h>

/// A growing block of memory, for example for libraries that write a file. All zero: empty.
typedef struct engine_bytes {
    const lobe_allocator *allocator;
    uint8_t *data; ///< from lobe_allocate
    size_t size, capacity;
} engine_bytes;

/// Makes the capacity at least `size` bytes; `bytes->size` stays. False if out of memory.
bool engine_bytes_reserve(engine_bytes *bytes, size_t size);

/// Writes at `offset`, which may be before or after the end; a gap is filled with zeroes. False if
/// out of memory; nothing has changed then.
bool engine_bytes_write(engine_bytes *bytes, size_t offset, const void *data, size_t size);

/// Frees the memory; `bytes` is empty then.
void engine_bytes_free(engine_bytes *bytes);

#endif
