#ifndef TOOLS_REPORT_PICTURE_STREAM_H
#define TOOLS_REPORT_PICTURE_STREAM_H

#include <stdio.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "tools/sweep/results.h"

/// Writes the pictures of a sweep for the script that draws the report, which cannot read OpenEXR.
/// Integers have 32 bits, in this machine's byte order:
///   - the colours of heat maps, from 0 to 1: 256 times R, G, B as bytes;
///   - for each scene the number of its pictures, and these: the index of the row, or 2^32 - 1 for
///     the reference; width; height; the linear texels (four floats each); the same tone-mapped for
///     a screen (R, G, B, A as bytes, sRGB).
/// A scene's reference comes first; only rows at their defaults that kept a picture are written.
/// `path` is that of the results; the names of pictures are relative to it. A reader that exits
/// early is not an error.
/// Errors: those of image_input_read, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result picture_stream_write(FILE *stream, const sweep_results *results, const char *path,
                                 const lobe_host *host);

#endif
