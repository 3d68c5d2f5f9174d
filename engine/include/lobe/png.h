#ifndef LOBE_PNG_H
#define LOBE_PNG_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Writes an RGBA8_SRGB or RGBA8_UNORM image without conversion: as RGB if every texel is opaque,
/// else as RGBA. Equal images give equal bytes. The file is written completely or not at all.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (another format), LOBE_ERROR_WRITE,
/// LOBE_ERROR_OUT_OF_MEMORY.
LOBE_API lobe_result lobe_png_write(const char *path, const lobe_image *image,
                                    const lobe_host *host);

/// Encodes in memory what lobe_png_write would write. The caller frees `*data` with lobe_release;
/// `name` is used in messages. On failure `*data` is NULL. Errors: those of lobe_png_write except
/// LOBE_ERROR_WRITE.
LOBE_API lobe_result lobe_png_encode(const char *name, const lobe_image *image,
                                     const lobe_host *host, uint8_t **data, size_t *size);

/// Reads any PNG file: into RGBA16_UNORM if it has 16 bits per channel, else into RGBA8_SRGB. Grey
/// is copied to R, G and B, palettes are expanded, missing alpha is opaque. Values are as stored:
/// colour chunks such as gAMA are not applied. `image` is overwritten; free it with
/// lobe_image_free.
/// Errors: LOBE_ERROR_NOT_FOUND, LOBE_ERROR_READ, LOBE_ERROR_MALFORMED (damaged or truncated),
/// LOBE_ERROR_LIMIT (too large), LOBE_ERROR_OUT_OF_MEMORY.
LOBE_API lobe_result lobe_png_read(const char *path, const lobe_host *host, lobe_image *image);

#ifdef __cplusplus
}
#endif

#endif
