#ifndef LOBE_EXR_H
#define LOBE_EXR_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// OpenEXR files: scene-referred linear RGB, several layers of the same extent in one file.

typedef enum lobe_exr_depth {
    LOBE_EXR_HALF,  ///< 16 bits; finite values beyond +-65504 are clamped, with a warning
    LOBE_EXR_FLOAT, ///< 32 bits; every value is stored unchanged, including NaN and infinity
} lobe_exr_depth;

typedef struct lobe_exr_layer {
    /// NULL: the main layer, whose channels have plain names (R, G, B, A). Otherwise the channels
    /// are called "NAME.CHANNEL", for example "normal.X" or "lobes.count".
    const char *name;
    /// A name for each channel of the image; NULL leaves that channel out. All NULL: R, G, B, A
    /// for an image of four channels, X, Y for two, Y for one.
    const char *channels[4];
    /// One of the formats R/RG/RGBA of 16_FLOAT or 32_FLOAT. For a file with MIP levels: an array
    /// of one image per level, the finest first, each half the size of the previous one (rounded
    /// down, at least 1), all with the same number of channels.
    const lobe_image *image;
    lobe_exr_depth depth;
} lobe_exr_layer;

typedef enum lobe_exr_attribute_type {
    LOBE_EXR_TEXT,
    LOBE_EXR_NUMBER,
    LOBE_EXR_INTEGER,
} lobe_exr_attribute_type;

/// A named value in the file's header.
typedef struct lobe_exr_attribute {
    const char *name; ///< 1 to 255 bytes; not an attribute of the format itself, such as "channels"
    lobe_exr_attribute_type type;
    const char *text; ///< UTF-8
    float number;
    int32_t integer;
} lobe_exr_attribute;

/// How the sphere of directions is mapped to an image (the standard attribute "envmap"). Cube: six
/// square faces below each other, +X -X +Y -Y +Z -Z, oriented as in ImfEnvmap.h.
typedef enum lobe_exr_environment {
    LOBE_EXR_NO_ENVIRONMENT, ///< not an environment, or the file does not say
    LOBE_EXR_LATITUDE_LONGITUDE,
    LOBE_EXR_CUBE,
} lobe_exr_environment;

typedef struct lobe_exr_parameters {
    const lobe_exr_layer *layers; ///< at least one; all images have the same extent
    size_t layer_count;
    const lobe_exr_attribute *attributes;
    size_t attribute_count;
    /// 0 means 1; more: all MIP levels down to a single texel, floor(log2(max(width, height))) + 1.
    uint32_t level_count;
    lobe_exr_environment environment;
} lobe_exr_parameters;

/// Writes one part, ZIP-compressed, with the chromaticities of Rec. 709 (white point D65): scan
/// lines, or tiles of 64x64 texels if there are several levels. Equal parameters give equal bytes.
/// The file is written completely or not at all.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (no layer, differing extents, wrong number of levels,
/// unsupported format, a duplicate or unnamed channel or attribute), LOBE_ERROR_WRITE,
/// LOBE_ERROR_OUT_OF_MEMORY.
LOBE_API lobe_result lobe_exr_write(const char *path, const lobe_exr_parameters *parameters,
                                    const lobe_host *host);

/// Largest number of texels that lobe_exr_read accepts (4 GiB of memory).
#define LOBE_EXR_MAXIMUM_TEXELS ((uint64_t)1 << 28)

/// Reads one layer into an RGBA32_FLOAT image; half and unsigned integer channels become float.
/// `layer` NULL: the main layer of the first part that has one. The image's extent is the display
/// window: texels that the data window does not cover are 0 (including alpha), and data outside the
/// display window is cut off.
///
/// Channels R, G, B (and A) keep their places; otherwise X, Y, Z become R, G, B; otherwise Y, or
/// the only channel, becomes all of R, G and B. Without a channel A, alpha is 1. Supports scan
/// lines and tiles, single and multi-part files, and every compression; reads the finest
/// resolution.
///
/// `image` is overwritten; free it with lobe_image_free.
/// Errors: LOBE_ERROR_NOT_FOUND (no file, or no layer of that name), LOBE_ERROR_READ,
/// LOBE_ERROR_MALFORMED (damaged or truncated), LOBE_ERROR_UNSUPPORTED (deep data, no suitable
/// channels, subsampled colour), LOBE_ERROR_LIMIT (too large),
/// LOBE_ERROR_OUT_OF_MEMORY.
LOBE_API lobe_result lobe_exr_read(const char *path, const char *layer, const lobe_host *host,
                                   lobe_image *image);

/// Everything lobe reads of one layer.
typedef struct lobe_exr_contents {
    /// The finest first, each RGBA32_FLOAT. Only the finest if there are no MIP levels, if the data
    /// window differs from the display window, or if the compression is DWAA or DWAB.
    lobe_image *levels;
    uint32_t level_count;
    lobe_exr_environment environment;
    /// Of the file's RGB: CIE x and y of red, green, blue and white, as lobe_image_to_rec709 takes
    /// them; those of Rec. 709 if the file does not say. Texels are as they are in the file.
    float chromaticities[4][2];
    lobe_exr_attribute *attributes; ///< texts, numbers and integers, in the order of the file
    size_t attribute_count;
} lobe_exr_contents;

/// Like lobe_exr_read, but with every level and the header's attributes. `contents` is overwritten;
/// free it with lobe_exr_contents_free. Same errors.
LOBE_API lobe_result lobe_exr_read_contents(const char *path, const char *layer,
                                            const lobe_host *host, lobe_exr_contents *contents);

/// The same for a file in memory: `data` is the whole file, and is needed only during the call.
/// `name` is used in messages.
LOBE_API lobe_result lobe_exr_decode_contents(const char *name, const void *data, size_t size,
                                              const char *layer, const lobe_host *host,
                                              lobe_exr_contents *contents);

/// NULL if there is none of this name and type.
LOBE_API const lobe_exr_attribute *lobe_exr_find_attribute(const lobe_exr_contents *contents,
                                                           const char *name,
                                                           lobe_exr_attribute_type type);

/// Frees everything and zeroes the structure. NULL is allowed.
LOBE_API void lobe_exr_contents_free(lobe_exr_contents *contents);

#ifdef __cplusplus
}
#endif

#endif
