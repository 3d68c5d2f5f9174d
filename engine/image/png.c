#include <lobe/png.h>

#include <png.h>
#include <stdbool.h>
#include <stdio.h>

#include <lobe/file.h>

#include "engine/base/bytes.h"
#include "third_party/image_codec.h"

// ---------------------------------------------------------------------------------------------
// Writing

/// libpng reports errors by longjmp, so everything that is needed after such a jump is here and not
/// in local variables.
typedef struct png_writer {
    png_structp png;
    png_infop information;
    engine_bytes output;
    char message[128]; ///< why libpng failed
} png_writer;

static void store_error(png_structp png, png_const_charp message) {
    png_writer *writer = png_get_error_ptr(png);
    snprintf(writer->message, sizeof writer->message, "%s", message);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static void append_output(png_structp png, png_bytep data, size_t size) {
    png_writer *writer = png_get_io_ptr(png);
    if (!engine_bytes_write(&writer->output, writer->output.size, data, size))
        png_error(png, "out of memory");
}

static void flush_output(png_structp png) {
    (void)png;
}

static bool is_opaque(const lobe_image *image) {
    const uint8_t *texels = image->texels;
    size_t count = (size_t)image->width * image->height;
    for (size_t index = 0; index < count; index++) {
        if (texels[4 * index + 3] != 255)
            return false;
    }
    return true;
}

static png_voidp allocate(png_structp png, png_alloc_size_t size) {
    return lobe_allocate(png_get_mem_ptr(png), size, 1);
}

static void release(png_structp png, png_voidp memory) {
    (void)png;
    lobe_release(memory);
}

static bool create(png_writer *writer) {
    snprintf(writer->message, sizeof writer->message, "out of memory");
    writer->png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, writer, store_error,
                                            ignore_warning, (png_voidp)writer->output.allocator,
                                            allocate, release); // only read
    if (writer->png != NULL)
        writer->information = png_create_info_struct(writer->png);
    return writer->information != NULL;
}

static bool encode(png_writer *writer, const lobe_image *image) {
    if (setjmp(png_jmpbuf(writer->png)))
        return false;
    bool opaque = is_opaque(image);
    png_set_write_fn(writer->png, writer, append_output, flush_output);
    png_set_IHDR(writer->png, writer->information, image->width, image->height, 8,
                 opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (image->format == LOBE_FORMAT_RGBA8_SRGB)
        png_set_sRGB(writer->png, writer->information, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(writer->png, writer->information);
    if (opaque)
        png_set_filler(writer->png, 0, PNG_FILLER_AFTER);
    for (uint32_t row = 0; row < image->height; row++)
        png_write_row(writer->png, (png_bytep)image->texels + 4 * (size_t)image->width * row);
    png_write_end(writer->png, NULL);
    return true;
}

/// On success the writer's output is the whole file. `name` is for messages.
static lobe_result encode_image(png_writer *writer, const char *name, const lobe_image *image,
                                const lobe_host *host) {
    *writer = (png_writer){.output.allocator = lobe_host_allocator(host)};
    if (image->width == 0 || image->height == 0)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "%s: an image of %ux%u texels",
                              name, image->width, image->height);
    if (image->format != LOBE_FORMAT_RGBA8_SRGB && image->format != LOBE_FORMAT_RGBA8_UNORM)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: PNG files are written from RGBA8 images, not from %s", name,
                              lobe_format_name(image->format));
    bool done = create(writer) && encode(writer, image);
    png_destroy_write_struct(&writer->png, &writer->information);
    return done ? LOBE_OK
                : lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: cannot be encoded: %s", name,
                                 writer->message);
}

lobe_result lobe_png_write(const char *path, const lobe_image *image, const lobe_host *host) {
    if (!path || !image || !image->texels)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_png_write: path, image and its texels must not be NULL");
    png_writer writer;
    lobe_result result = encode_image(&writer, path, image, host);
    if (result == LOBE_OK)
        result = lobe_file_write(path, writer.output.data, writer.output.size, host);
    engine_bytes_free(&writer.output);
    return result;
}

lobe_result lobe_png_encode(const char *name, const lobe_image *image, const lobe_host *host,
                            uint8_t **data, size_t *size) {
    if (data)
        *data = NULL;
    if (!name || !image || !image->texels || !data || !size)
        return lobe_host_fail(
            host, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_png_encode: name, image, its texels, data and size must not be NULL");
    png_writer writer;
    lobe_result result = encode_image(&writer, name, image, host);
    *data = result == LOBE_OK ? writer.output.data : NULL;
    *size = result == LOBE_OK ? writer.output.size : 0;
    if (result != LOBE_OK)
        engine_bytes_free(&writer.output);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Reading

/// Deflate compresses by at most 1032 to 1, and a texel needs at least one bit: a header that
/// promises more than the file can contain is rejected before memory is allocated for it.
static bool fits_file(const image_codec_extent *extent, size_t size) {
    return (uint64_t)extent->width * extent->height / 8 / 1032 <= size;
}

static void *resize(void *allocator, void *memory, size_t size) {
    return lobe_reallocate(allocator, memory, size, 1);
}

static lobe_result fail_reading(const library_memory *memory, const char *path, const char *message,
                                const lobe_host *host) {
    if (memory->failed)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory decoding it",
                              path);
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: %s", path, message);
}

static lobe_result decode(const char *path, const uint8_t *data, size_t size, const lobe_host *host,
                          lobe_image *image) {
    char message[IMAGE_CODEC_MESSAGE_SIZE] = "";
    library_memory memory = {.resize = resize,
                             .release = lobe_release,
                             .user = (void *)lobe_host_allocator(host)}; // only read
    image_codec_extent extent;
    if (size < 8 || png_sig_cmp(data, 0, 8) != 0)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: not a PNG file", path);
    if (!third_party_png_measure(data, size, &memory, &extent, message) || memory.failed)
        return fail_reading(&memory, path, message, host);
    if (extent.width > LOBE_IMAGE_MAXIMUM_EXTENT || extent.height > LOBE_IMAGE_MAXIMUM_EXTENT)
        return lobe_host_fail(host, LOBE_ERROR_LIMIT, "%s: %ux%u texels is above %ux%u", path,
                              extent.width, extent.height, LOBE_IMAGE_MAXIMUM_EXTENT,
                              LOBE_IMAGE_MAXIMUM_EXTENT);
    if (!fits_file(&extent, size))
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: damaged PNG file: %ux%u texels cannot be in %zu bytes", path,
                              extent.width, extent.height, size);
    lobe_result result = lobe_image_allocate(
        image, extent.sixteen_bits ? LOBE_FORMAT_RGBA16_UNORM : LOBE_FORMAT_RGBA8_SRGB,
        extent.width, extent.height, host);
    if (result != LOBE_OK)
        return result;
    if (!third_party_png_decode(data, size, &memory, &extent, true, image->texels, message) ||
        memory.failed)
        return fail_reading(&memory, path, message, host);
    return result;
}

lobe_result lobe_png_read(const char *path, const lobe_host *host, lobe_image *image) {
    if (image)
        *image = (lobe_image){0};
    if (!path || !image)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_png_read: path and image must not be NULL");
    uint8_t *data;
    size_t size;
    lobe_result result = lobe_file_read(path, NULL, host, &data, &size);
    if (result == LOBE_OK)
        result = decode(path, data, size, host, image);
    if (result != LOBE_OK)
        lobe_image_free(image);
    lobe_release(data);
    return result;
}
