#ifndef PASSES_CONTEXT_DIGEST_H
#define PASSES_CONTEXT_DIGEST_H

#include <stddef.h>
#include <stdint.h>

/// Digests of what files in a cache folder were made from: the same in every process, so that they
/// name the files. They must never change.

/// A digest that goes on with another number.
uint64_t passes_digest(uint64_t digest, uint64_t number);
/// The same for words of eight bytes, the last one filled up with zeros.
uint64_t passes_digest_bytes(uint64_t digest, const void *bytes, size_t size);

/// Sixteen hexadecimal digits.
typedef struct digest_text {
    char text[17];
} digest_text;

digest_text passes_digest_print(uint64_t digest);

#endif
