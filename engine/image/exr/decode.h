#ifndef ENGINE_IMAGE_EXR_DECODE_H
#define ENGINE_IMAGE_EXR_DECODE_H

#include <stdbool.h>

#include <lobe/image.h>

#include "engine/image/exr/input.h"

/// A block of texels, in the coordinates of the windows.
typedef struct exr_block {
    int64_t x, y, width, height;
} exr_block;

/// One layer of an open file.
typedef struct exr_reader {
    exr_input input;
    int part;
    const exr_attr_chlist_t *channels;
    int sources[4]; ///< for R, G, B, A: index into `channels`; -1: none
    exr_attr_box2i_t data_window, display_window;
    uint32_t level_count; ///< that can be read
    exr_decode_pipeline_t pipeline;
    bool pipeline_started;
    // Of the level being read
    int level;
    exr_block data, display;
    lobe_image *image;
} exr_reader;

/// The window as a block, in the file's coordinates.
exr_block engine_exr_block_of_window(const exr_attr_box2i_t *window);

/// Whether the part's compression (DWAA, DWAB) is not implemented in OpenEXRCore 3.1. Of such
/// parts, the OpenEXR library reads the finest level.
bool engine_exr_is_left_to_openexr(const exr_reader *reader);

/// Reads a level, below `level_count`, into a new RGBA32_FLOAT image. The caller frees it, also
/// after a failure. Sizes must have been checked.
lobe_result engine_exr_decode_level(exr_reader *reader, uint32_t level, lobe_image *image);

#endif
