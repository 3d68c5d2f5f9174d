#ifndef THIRD_PARTY_IMAGE_CODEC_H
#define THIRD_PARTY_IMAGE_CODEC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "third_party/library_memory.h"

/// PNG through libpng and JPEG through libjpeg-turbo, from memory to RGBA. Whatever the bytes are,
/// no call prints, exits or jumps out. Beyond what the library needs for a progressive or
/// interlaced image, only a few rows are allocated. libpng uses `memory`, which also records
/// whether it ran out; libjpeg has no allocator interface.

#define IMAGE_CODEC_MESSAGE_SIZE 256

typedef struct image_codec_extent {
    uint32_t width, height; ///< texels
    bool sixteen_bits;      ///< a channel; else 8 or fewer
} image_codec_extent;

/// Reads only the header. False: `message` says why.
bool third_party_png_measure(const void *bytes, size_t size, library_memory *memory,
                             image_codec_extent *extent, char message[IMAGE_CODEC_MESSAGE_SIZE]);
bool third_party_jpeg_measure(const void *bytes, size_t size, image_codec_extent *extent,
                              char message[IMAGE_CODEC_MESSAGE_SIZE]);

/// Decodes to `rgba`: rows from the top, packed, 4 channels of 8 bits, or of 16 bits in the
/// machine's order where `sixteen_bits` is asked for and the image has them. `extent` is what was
/// measured. A file that ends early fails.
bool third_party_png_decode(const void *bytes, size_t size, library_memory *memory,
                            const image_codec_extent *extent, bool sixteen_bits, void *rgba,
                            char message[IMAGE_CODEC_MESSAGE_SIZE]);
bool third_party_jpeg_decode(const void *bytes, size_t size, const image_codec_extent *extent,
                             void *rgba, char message[IMAGE_CODEC_MESSAGE_SIZE]);

#endif
