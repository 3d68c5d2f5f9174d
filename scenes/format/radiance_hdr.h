#ifndef SCENES_FORMAT_RADIANCE_HDR_H
#define SCENES_FORMAT_RADIANCE_HDR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// Radiance pictures (.hdr, .pic).

/// Whether the bytes begin like such a picture.
bool scenes_radiance_hdr_recognise(const void *bytes, size_t size);

/// Decodes a picture into RGBA32_FLOAT with alpha 1. Scan lines may be packed in the newer way, in
/// the older way, or not at all; they may run in any of the eight directions. Exposures and colour
/// corrections stated in the header are undone, so that the image holds radiance. CIE XYZ becomes
/// RGB with Radiance's primaries, which are near those of Rec. 709; RGB is taken to have those
/// already, unless the header states others, from which it is converted to Rec. 709. `name` is for
/// messages. On failure `image` is empty. Errors: LOBE_ERROR_MALFORMED, _UNSUPPORTED (another
/// format of texels), _LIMIT, _OUT_OF_MEMORY.
lobe_result scenes_radiance_hdr_decode(const void *bytes, size_t size, const char *name,
                                       const lobe_host *host, lobe_image *image);

#endif
