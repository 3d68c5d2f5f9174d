#ifndef TOOLS_REPORT_PICTURE_STREAM_H
#define TOOLS_REPORT_PICTURE_STREAM_H

#include <stdio.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "tools/sweep/results.h"

/// Writes the pictures that a sweep names, for the script that draws the report, which reads no
/// OpenEXR. Whole numbers have 32 bits; bytes are in this machine's order:
///   - the colours of heat maps, from 0 to 1: 256 times R, G, B as bytes;
///   - for each scene the number of its pictures, and these: the index of the row, or 2^32 - 1 for
///     the reference; width; height; the linear texels (four floats each); the same tone-mapped for
///     a screen (R, G, B, A as bytes, sRGB).
/// A scene's reference comes first; rows are those at their defaults that kept a picture.
/// `path` is that of the results, which the names of pictures are relative to. A reader that goes
/// away early is no failure here.
/// Errors: those of image_input_read, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result picture_stream_write(FILE *stream, const sweep_results *results, const char *path,
                                 const lobe_host *host);

#endif
