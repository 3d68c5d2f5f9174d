#ifndef ENGINE_IMAGE_EXR_ENCODE_H
#define ENGINE_IMAGE_EXR_ENCODE_H

#include <openexr.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/exr.h>

#include "engine/base/bytes.h"

#define EXR_NAME_MAXIMUM_LENGTH 255
/// Texels of a tile in each direction.
#define EXR_TILE_SIZE 64

typedef struct exr_channel {
    char name[EXR_NAME_MAXIMUM_LENGTH + 1];
    const lobe_exr_layer *layer;
    uint32_t component; ///< of the layer's image
} exr_channel;

/// A file being written into memory.
typedef struct exr_writer {
    const char *path;
    const lobe_host *host;
    uint32_t width, height; ///< texels of the finest level
    uint32_t level_count;   ///< above 1: MIP levels in tiles
    exr_channel *channels;  ///< sorted by name, as the format requires
    size_t channel_count;
    engine_bytes output;
    exr_context_t context;
    exr_encode_pipeline_t pipeline;
    bool pipeline_started;
    exr_result_t (*compress)(exr_encode_pipeline_t *pipeline); ///< OpenEXRCore's own
    uint8_t *block;     ///< texels of one block, channel after channel
    size_t block_size;  ///< capacity of `block` in bytes
    size_t clamped;     ///< values beyond the range of half
    bool out_of_memory; ///< while growing `output`
} exr_writer;

/// Writes all texels, after the header: as scan lines, or level after level as tiles.
exr_result_t engine_exr_write_texels(exr_writer *writer);

/// Frees what engine_exr_write_texels allocated, if anything.
void engine_exr_free_texels(exr_writer *writer);

#endif
