#ifndef THIRD_PARTY_GZIP_H
#define THIRD_PARTY_GZIP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "third_party/library_memory.h"

/// Decompresses gzip files (RFC 1952) through zlib, from memory to memory.

#define GZIP_MESSAGE_SIZE 128

/// Whether the bytes begin like a gzip file.
bool third_party_gzip_recognise(const void *bytes, size_t size);

/// Unpacks all members of the file, one after the other. `*unpacked` comes from `memory`; a zero
/// byte that `*unpacked_size` does not count follows. At most `maximum` bytes are unpacked. False:
/// `*unpacked` is NULL and `message` says why (broken, ends early, too large, or `memory->failed`).
bool third_party_gzip_unpack(const void *bytes, size_t size, size_t maximum, library_memory *memory,
                             uint8_t **unpacked, size_t *unpacked_size,
                             char message[GZIP_MESSAGE_SIZE]);

#endif
