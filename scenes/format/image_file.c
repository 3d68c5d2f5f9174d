#include "scenes/format/image_file.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include <lobe/file.h>

#include "scenes/format/exr_file.h"
#include "scenes/format/library_memory.h"
#include "third_party/image_codec.h"

// The best compression of either format: deflate shrinks to 1/1032, with 8 texels per byte.
#define MAXIMUM_TEXELS_PER_BYTE (1032 * 8)

typedef enum image_file_kind { IMAGE_FILE_OTHER, IMAGE_FILE_PNG, IMAGE_FILE_JPEG } image_file_kind;

static image_file_kind recognise(const void *bytes, size_t size) {
    static const uint8_t png[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static const uint8_t jpeg[3] = {0xff, 0xd8, 0xff};
    if (size >= sizeof png && memcmp(bytes, png, sizeof png) == 0)
        return IMAGE_FILE_PNG;
    if (size >= sizeof jpeg && memcmp(bytes, jpeg, sizeof jpeg) == 0)
        return IMAGE_FILE_JPEG;
    return IMAGE_FILE_OTHER;
}

// Checked before allocating memory for what a header of a few bytes claims.
static lobe_result check_extent(const image_codec_extent *extent, size_t size, const char *name,
                                const lobe_host *host) {
    uint32_t width = extent->width, height = extent->height;
    uint64_t texels = (uint64_t)width * height;
    if (width > LOBE_IMAGE_MAXIMUM_EXTENT || height > LOBE_IMAGE_MAXIMUM_EXTENT ||
        texels > SCENE_IMAGE_MAXIMUM_TEXELS)
        return lobe_host_fail(host, LOBE_ERROR_LIMIT,
                              "%s: %u x %u texels exceed lobe's limits (%u per side, %zu in "
                              "all)",
                              name, width, height, LOBE_IMAGE_MAXIMUM_EXTENT,
                              SCENE_IMAGE_MAXIMUM_TEXELS);
    if (texels > (uint64_t)size * MAXIMUM_TEXELS_PER_BYTE)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: %zu bytes cannot hold %u x %u texels", name, size, width,
                              height);
    return LOBE_OK;
}

static lobe_format choose_format(bool sixteen_bits, scene_image_use use) {
    if (use == SCENE_IMAGE_COLOUR)
        return LOBE_FORMAT_RGBA8_SRGB;
    return sixteen_bits ? LOBE_FORMAT_RGBA16_UNORM : LOBE_FORMAT_RGBA8_UNORM;
}

static lobe_result fail(const library_memory *memory, const char *name, const char *message,
                        const lobe_host *host) {
    if (memory->failed)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", name);
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: %s", name, message);
}

lobe_result scenes_image_decode(const void *bytes, size_t size, const char *name,
                                scene_image_use use, const lobe_host *host, lobe_image *image) {
    *image = (lobe_image){0};
    image_file_kind kind = recognise(bytes, size);
    if (kind == IMAGE_FILE_OTHER)
        return lobe_host_fail(host, size < 8 ? LOBE_ERROR_MALFORMED : LOBE_ERROR_UNSUPPORTED,
                              "%s: neither PNG nor JPEG", name);
    char message[IMAGE_CODEC_MESSAGE_SIZE] = "";
    library_memory memory = scenes_library_memory(host);
    image_codec_extent extent = {0};
    bool png = kind == IMAGE_FILE_PNG;
    bool done = png ? third_party_png_measure(bytes, size, &memory, &extent, message)
                    : third_party_jpeg_measure(bytes, size, &extent, message);
    if (!done || memory.failed)
        return fail(&memory, name, message, host);
    lobe_result result = check_extent(&extent, size, name, host);
    if (result != LOBE_OK)
        return result;
    lobe_format format = choose_format(extent.sixteen_bits, use);
    result = lobe_image_allocate(image, format, extent.width, extent.height, host);
    if (result != LOBE_OK)
        return result;
    done = png ? third_party_png_decode(bytes, size, &memory, &extent,
                                        format == LOBE_FORMAT_RGBA16_UNORM, image->texels, message)
               : third_party_jpeg_decode(bytes, size, &extent, image->texels, message);
    if (done && !memory.failed)
        return LOBE_OK;
    lobe_image_free(image);
    return fail(&memory, name, message, host);
}

lobe_result scenes_image_load(const char *path, scene_image_use use, const lobe_host *host,
                              lobe_image *image) {
    *image = (lobe_image){0};
    uint8_t *bytes = NULL;
    size_t size = 0;
    lobe_result result = lobe_file_read(path, NULL, host, &bytes, &size);
    if (result == LOBE_OK)
        result =
            scenes_exr_recognise(bytes, size)
                ? scenes_exr_decode_map(bytes, size, path, choose_format(true, use), host, image)
                : scenes_image_decode(bytes, size, path, use, host, image);
    lobe_release(bytes);
    return result;
}
