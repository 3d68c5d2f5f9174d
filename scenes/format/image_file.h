#ifndef SCENES_FORMAT_IMAGE_FILE_H
#define SCENES_FORMAT_IMAGE_FILE_H

#include <stddef.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// The meaning of an image file's numbers, which neither PNG nor JPEG states reliably.
typedef enum scene_image_use {
    SCENE_IMAGE_COLOUR, ///< sRGB; becomes RGBA8_SRGB
    SCENE_IMAGE_DATA,   ///< linear; becomes RGBA8_UNORM, or RGBA16_UNORM from 16 bits
} scene_image_use;

/// Largest number of texels of one image file.
#define SCENE_IMAGE_MAXIMUM_TEXELS ((size_t)1 << 28)

/// Decodes PNG or JPEG, recognised by their first bytes. Grey becomes RGB, a missing alpha 1;
/// colour profiles are ignored. `name` is for messages. On failure `image` is empty. Errors:
/// LOBE_ERROR_UNSUPPORTED (another format), _MALFORMED, _LIMIT (extent above
/// LOBE_IMAGE_MAXIMUM_EXTENT, or too many texels), _OUT_OF_MEMORY.
lobe_result scenes_image_decode(const void *bytes, size_t size, const char *name,
                                scene_image_use use, const lobe_host *host, lobe_image *image);

/// The same for a file, which may be OpenEXR too (see scenes_exr_decode_map); also
/// LOBE_ERROR_NOT_FOUND and LOBE_ERROR_READ.
lobe_result scenes_image_load(const char *path, scene_image_use use, const lobe_host *host,
                              lobe_image *image);

#endif
