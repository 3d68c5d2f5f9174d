#include <lobe/image.h>

typedef struct format_information {
    const char *name;
    uint8_t size; ///< bytes of a texel
    uint8_t channels;
} format_information;

static const format_information *describe(lobe_format format) {
    static const format_information formats[LOBE_FORMAT_COUNT] = {
        [LOBE_FORMAT_NONE] = {"NONE", 0, 0},
        [LOBE_FORMAT_R8_UNORM] = {"R8_UNORM", 1, 1},
        [LOBE_FORMAT_RG8_UNORM] = {"RG8_UNORM", 2, 2},
        [LOBE_FORMAT_RG8_SNORM] = {"RG8_SNORM", 2, 2},
        [LOBE_FORMAT_RGBA8_UNORM] = {"RGBA8_UNORM", 4, 4},
        [LOBE_FORMAT_RGBA8_SNORM] = {"RGBA8_SNORM", 4, 4},
        [LOBE_FORMAT_RGBA8_SRGB] = {"RGBA8_SRGB", 4, 4},
        [LOBE_FORMAT_RG16_UNORM] = {"RG16_UNORM", 4, 2},
        [LOBE_FORMAT_RG16_SNORM] = {"RG16_SNORM", 4, 2},
        [LOBE_FORMAT_RGBA16_UNORM] = {"RGBA16_UNORM", 8, 4},
        [LOBE_FORMAT_RGBA16_SNORM] = {"RGBA16_SNORM", 8, 4},
        [LOBE_FORMAT_R16_FLOAT] = {"R16_FLOAT", 2, 1},
        [LOBE_FORMAT_RG16_FLOAT] = {"RG16_FLOAT", 4, 2},
        [LOBE_FORMAT_RGBA16_FLOAT] = {"RGBA16_FLOAT", 8, 4},
        [LOBE_FORMAT_R32_FLOAT] = {"R32_FLOAT", 4, 1},
        [LOBE_FORMAT_RG32_FLOAT] = {"RG32_FLOAT", 8, 2},
        [LOBE_FORMAT_RGBA32_FLOAT] = {"RGBA32_FLOAT", 16, 4},
        [LOBE_FORMAT_BGRA8_UNORM] = {"BGRA8_UNORM", 4, 4},
        [LOBE_FORMAT_BGRA8_SRGB] = {"BGRA8_SRGB", 4, 4},
        [LOBE_FORMAT_D32_FLOAT] = {"D32_FLOAT", 4, 1},
        [LOBE_FORMAT_RG11B10_FLOAT] = {"RG11B10_FLOAT", 4, 3},
        [LOBE_FORMAT_RGB10A2_UNORM] = {"RGB10A2_UNORM", 4, 4},
        [LOBE_FORMAT_BGR10A2_UNORM] = {"BGR10A2_UNORM", 4, 4},
        [LOBE_FORMAT_BC1_UNORM] = {"BC1_UNORM", 0, 4},
        [LOBE_FORMAT_BC1_SRGB] = {"BC1_SRGB", 0, 4},
        [LOBE_FORMAT_BC3_UNORM] = {"BC3_UNORM", 0, 4},
        [LOBE_FORMAT_BC3_SRGB] = {"BC3_SRGB", 0, 4},
        [LOBE_FORMAT_BC4_UNORM] = {"BC4_UNORM", 0, 1},
        [LOBE_FORMAT_BC5_UNORM] = {"BC5_UNORM", 0, 2},
        [LOBE_FORMAT_BC5_SNORM] = {"BC5_SNORM", 0, 2},
        [LOBE_FORMAT_BC7_UNORM] = {"BC7_UNORM", 0, 4},
        [LOBE_FORMAT_BC7_SRGB] = {"BC7_SRGB", 0, 4},
    };
    return &formats[(unsigned)format < LOBE_FORMAT_COUNT ? format : LOBE_FORMAT_NONE];
}

size_t lobe_format_size(lobe_format format) {
    return describe(format)->size;
}

uint32_t lobe_format_channels(lobe_format format) {
    return describe(format)->channels;
}

const char *lobe_format_name(lobe_format format) {
    return describe(format)->name;
}

bool lobe_rectangle_lies_within(const lobe_rectangle *rectangle, uint32_t width, uint32_t height) {
    return rectangle && rectangle->width > 0 && rectangle->height > 0 && rectangle->x < width &&
           rectangle->y < height && rectangle->width <= width - rectangle->x &&
           rectangle->height <= height - rectangle->y;
}

lobe_result lobe_image_allocate(lobe_image *image, lobe_format format, uint32_t width,
                                uint32_t height, const lobe_host *host) {
    if (!image)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_image_allocate: image must not be NULL");
    *image = (lobe_image){0};
    size_t size = lobe_format_size(format);
    if (size == 0)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "image: no format of single texels is given");
    if (width == 0 || height == 0 || width > LOBE_IMAGE_MAXIMUM_EXTENT ||
        height > LOBE_IMAGE_MAXIMUM_EXTENT)
        return lobe_host_fail(host, LOBE_ERROR_LIMIT,
                              "image: %ux%u texels is not within 1x1 to %ux%u", width, height,
                              LOBE_IMAGE_MAXIMUM_EXTENT, LOBE_IMAGE_MAXIMUM_EXTENT);
    void *texels = lobe_allocate(lobe_host_allocator(host), (size_t)width * height, size);
    if (texels == NULL)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY,
                              "image: out of memory for %ux%u texels of %s", width, height,
                              lobe_format_name(format));
    *image = (lobe_image){format, width, height, texels};
    return LOBE_OK;
}

void lobe_image_free(lobe_image *image) {
    if (image == NULL)
        return;
    lobe_release(image->texels);
    *image = (lobe_image){0};
}
