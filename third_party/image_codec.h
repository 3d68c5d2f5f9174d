#ifndef THIRD_PARTY_IMAGE_CODEC_H
#define THIRD_PARTY_IMAGE_CODEC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "third_party/library_memory.h"

/// PNG through libpng and JPEG through libjpeg-turbo, from memory to RGBA. No call prints, exits
/// or jumps out of itself, whatever the bytes are; none allocates more than a few rows beside
/// what it is given and what the library takes for a progressive or interlaced image. libpng takes
/// that from `memory`, which says where it has run out; libjpeg cannot be told where from.

#define IMAGE_CODEC_MESSAGE_SIZE 256

typedef struct image_codec_extent {
    uint32_t width, height; ///< texels
    bool sixteen_bits;      ///< a channel; else 8 or fewer
} image_codec_extent;

/// Reads the header alone. False: `message` says why.
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
