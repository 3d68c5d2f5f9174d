#include <lobe/allocator.h>

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/// Precedes each block, so that lobe_release needs nothing but the block.
typedef struct block_header {
    alignas(max_align_t) const lobe_allocator *allocator; ///< NULL: the C library's
    size_t size;                                          ///< bytes, this header included
} block_header;

_Static_assert(alignof(max_align_t) <= 16, "lobe_allocator promises 16 bytes");

/// Bytes of a block with its header; 0 if that is more than an object can have.
static size_t block_size(size_t count, size_t size) {
    if (size > 0 && count > (PTRDIFF_MAX - sizeof(block_header)) / size)
        return 0;
    return sizeof(block_header) + count * size;
}

static block_header *header_of(void *memory) {
    return (block_header *)memory - 1;
}

/// The bytes after the header are zeroed.
static block_header *take(const lobe_allocator *allocator, size_t size) {
    if (!allocator) // calloc knows which pages are zero already
        return calloc(1, size);
    block_header *header = allocator->allocate(allocator->user, size);
    return header ? memset(header, 0, size) : NULL;
}

void *lobe_allocate(const lobe_allocator *allocator, size_t count, size_t size) {
    const size_t whole = block_size(count, size);
    block_header *header = whole ? take(allocator, whole) : NULL;
    if (!header)
        return NULL;
    *header = (block_header){allocator, whole};
    return header + 1;
}

/// lobe_allocator has no function to resize: most hosts could only do the same.
static void *move(block_header *header, size_t whole) {
    const lobe_allocator *allocator = header->allocator;
    block_header *moved = allocator->allocate(allocator->user, whole);
    if (!moved)
        return NULL;
    memcpy(moved, header, header->size < whole ? header->size : whole);
    allocator->release(allocator->user, header, header->size);
    moved->size = whole;
    return moved + 1;
}

void *lobe_reallocate(const lobe_allocator *allocator, void *memory, size_t count, size_t size) {
    if (!memory)
        return lobe_allocate(allocator, count, size);
    const size_t whole = block_size(count, size);
    block_header *header = header_of(memory);
    if (whole == 0)
        return NULL;
    if (header->allocator)
        return move(header, whole);
    header = realloc(header, whole);
    if (!header)
        return NULL;
    header->size = whole;
    return header + 1;
}

char *lobe_copy_text(const lobe_allocator *allocator, const char *text) {
    if (!text)
        return NULL;
    const size_t size = strlen(text) + 1;
    char *copy = lobe_allocate(allocator, size, 1);
    return copy ? memcpy(copy, text, size) : NULL;
}

void lobe_release(void *memory) {
    if (!memory)
        return;
    block_header *header = header_of(memory);
    const lobe_allocator *allocator = header->allocator;
    if (allocator)
        allocator->release(allocator->user, header, header->size);
    else
        free(header);
}
