#ifndef SCENES_FORMAT_EXR_FILE_H
#define SCENES_FORMAT_EXR_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/exr.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// Whether a file begins as OpenEXR files do.
bool scenes_exr_recognise(const void *bytes, size_t size);

/// Moves the finest level out of what was read, with linear colours of the primaries of Rec. 709,
/// and frees the rest. `name` is for a warning if the file's own primaries span no colours.
void scenes_exr_take_colours(lobe_exr_contents *contents, const char *name, const lobe_host *host,
                             lobe_image *image);

/// The finest level of the main layer, with linear colours of the primaries of Rec. 709, as
/// RGBA32_FLOAT. `said` (NULL: not wanted): see lobe_exr_contents. On failure `image` is empty.
/// Errors as lobe_exr_decode_contents.
lobe_result scenes_exr_decode(const void *bytes, size_t size, const char *name,
                              const lobe_host *host, lobe_image *image, lobe_exr_environment *said);

/// The same as RGBA8_SRGB, for colours, or RGBA16_UNORM, for data, which keep their primaries.
/// Values outside [0, 1] become its ends and NaN 0, with a warning that counts the texels.
lobe_result scenes_exr_decode_map(const void *bytes, size_t size, const char *name,
                                  lobe_format format, const lobe_host *host, lobe_image *image);

#endif
