#ifndef LOBE_IMAGE_H
#define LOBE_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Texel formats, for images in host memory and on the device. Channels are stored in order,
/// little-endian. `_SRGB`: colour is encoded with the sRGB curve, alpha is linear.
typedef enum lobe_format {
    LOBE_FORMAT_NONE = 0,
    LOBE_FORMAT_R8_UNORM,
    LOBE_FORMAT_RG8_UNORM,
    LOBE_FORMAT_RG8_SNORM, ///< [-1, 1]: -128 and -127 are both -1
    LOBE_FORMAT_RGBA8_UNORM,
    LOBE_FORMAT_RGBA8_SNORM,
    LOBE_FORMAT_RGBA8_SRGB,
    LOBE_FORMAT_RG16_UNORM,
    LOBE_FORMAT_RG16_SNORM,
    LOBE_FORMAT_RGBA16_UNORM,
    LOBE_FORMAT_RGBA16_SNORM,
    LOBE_FORMAT_R16_FLOAT,
    LOBE_FORMAT_RG16_FLOAT,
    LOBE_FORMAT_RGBA16_FLOAT,
    LOBE_FORMAT_R32_FLOAT,
    LOBE_FORMAT_RG32_FLOAT,
    LOBE_FORMAT_RGBA32_FLOAT,
    LOBE_FORMAT_BGRA8_UNORM, ///< common for displays
    LOBE_FORMAT_BGRA8_SRGB,
    LOBE_FORMAT_D32_FLOAT, ///< depth, device images only
    // Channels packed into 32 bits, the first in the lowest: device images only.
    LOBE_FORMAT_RG11B10_FLOAT, ///< not negative
    LOBE_FORMAT_RGB10A2_UNORM,
    LOBE_FORMAT_BGR10A2_UNORM,
    // Compressed in blocks of 4x4 texels: images of a host's Vulkan only, for sampling.
    LOBE_FORMAT_BC1_UNORM, ///< with alpha of one bit
    LOBE_FORMAT_BC1_SRGB,
    LOBE_FORMAT_BC3_UNORM,
    LOBE_FORMAT_BC3_SRGB,
    LOBE_FORMAT_BC4_UNORM, ///< one channel
    LOBE_FORMAT_BC5_UNORM, ///< two channels
    LOBE_FORMAT_BC5_SNORM,
    LOBE_FORMAT_BC7_UNORM,
    LOBE_FORMAT_BC7_SRGB,
    LOBE_FORMAT_COUNT
} lobe_format;

/// Bytes of one texel; 0 for LOBE_FORMAT_NONE and for formats of blocks.
LOBE_API size_t lobe_format_size(lobe_format format);
/// Channels of one texel [1, 4]; 0 for LOBE_FORMAT_NONE.
LOBE_API uint32_t lobe_format_channels(lobe_format format);
/// For example "RGBA16_FLOAT". Never NULL.
LOBE_API const char *lobe_format_name(lobe_format format);

/// A two-dimensional image in host memory: rows from top to bottom, tightly packed. A host may fill
/// one in itself; if lobe is to free it, the texels must come from lobe_allocate.
typedef struct lobe_image {
    lobe_format format;
    uint32_t width;  ///< texels
    uint32_t height; ///< texels
    void *texels;    ///< width * height * lobe_format_size(format) bytes, owned by the image
} lobe_image;

/// Texels of an image: `width` columns from `x` on, `height` rows from `y` on.
typedef struct lobe_rectangle {
    uint32_t x, y, width, height;
} lobe_rectangle;

/// Whether a rectangle has texels, all of them in an image of this extent.
LOBE_API bool lobe_rectangle_lies_within(const lobe_rectangle *rectangle, uint32_t width,
                                         uint32_t height);

/// Largest width or height of any image in lobe, in texels.
#define LOBE_IMAGE_MAXIMUM_EXTENT 65535u

/// Allocates zeroed texels. `image` is overwritten; free it with lobe_image_free.
/// Errors: LOBE_ERROR_LIMIT for an extent of 0 or above LOBE_IMAGE_MAXIMUM_EXTENT,
/// LOBE_ERROR_OUT_OF_MEMORY. `host` may be NULL.
LOBE_API lobe_result lobe_image_allocate(lobe_image *image, lobe_format format, uint32_t width,
                                         uint32_t height, const lobe_host *host);

/// Frees the texels and zeroes the structure. NULL and an already freed image are allowed.
LOBE_API void lobe_image_free(lobe_image *image);

#ifdef __cplusplus
}
#endif

#endif
