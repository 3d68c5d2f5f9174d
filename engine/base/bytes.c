#include "engine/base/bytes.h"

#include <string.h>

#define FIRST_CAPACITY 64

bool engine_bytes_reserve(engine_bytes *bytes, size_t size) {
    if (size <= bytes->capacity)
        return true;
    size_t capacity = bytes->capacity ? bytes->capacity : FIRST_CAPACITY;
    while (capacity < size && capacity <= SIZE_MAX / 2)
        capacity *= 2;
    uint8_t *data =
        capacity >= size ? lobe_reallocate(bytes->allocator, bytes->data, capacity, 1) : NULL;
    if (data == NULL)
        return false;
    bytes->data = data;
    bytes->capacity = capacity;
    return true;
}

bool engine_bytes_write(engine_bytes *bytes, size_t offset, const void *data, size_t size) {
    if (size > SIZE_MAX - offset || !engine_bytes_reserve(bytes, offset + size))
        return false;
    if (offset > bytes->size)
        memset(bytes->data + bytes->size, 0, offset - bytes->size);
    if (size > 0)
        memcpy(bytes->data + offset, data, size);
    if (offset + size > bytes->size)
        bytes->size = offset + size;
    return true;
}

void engine_bytes_free(engine_bytes *bytes) {
    lobe_release(bytes->data);
    *bytes = (engine_bytes){.allocator = bytes->allocator};
}
