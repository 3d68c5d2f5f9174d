#ifndef TESTS_ENGINE_SUPPORT_EXR_FIXTURE_H
#define TESTS_ENGINE_SUPPORT_EXR_FIXTURE_H

#include <stdbool.h>
#include <stddef.h>

#include <openexr.h>

/// OpenEXR files of kinds that lobe reads but does not write, made with OpenEXRCore.

typedef struct exr_fixture_channel {
    const char *name;
    exr_pixel_type_t type;
    int sampling; ///< of x and y; 0 means 1
} exr_fixture_channel;

typedef struct exr_fixture_part {
    const char *name; ///< NULL in a file with one part
    exr_attr_box2i_t data_window, display_window;
    exr_compression_t compression;
    int tile_width, tile_height; ///< 0: scan lines
    bool mipmap;
    const exr_fixture_channel *channels; ///< sorted by name
    int channel_count;
} exr_fixture_part;

/// What channel `channel` holds at (x, y) in window coordinates on the finest level: a small whole
/// number, exact in all types; other levels hold the negative of it (0 in unsigned channels).
float exr_fixture_value(int channel, int x, int y);

/// Fails the test if the file cannot be written.
void exr_fixture_write(const char *path, const exr_fixture_part *parts, int count);

#endif
