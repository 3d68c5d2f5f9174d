#include "passes/filters/mixture/mixture_file.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <lobe/file.h>

#include "passes/context/digest.h"

/// All members are compared with what a file must have; then come the bins and the rows.
typedef struct file_header {
    char name[8];
    uint32_t byte_order;
    uint32_t version;
    uint64_t key;
    uint32_t format, width, height, layers;
    uint32_t levels, rows;
    uint64_t checksum; ///< of the bins and the rows
} file_header;

_Static_assert(sizeof(file_header) == 56, "file_header has no gaps");

static size_t texel_count(const mixture_extent *extent) {
    const reduced_map map = {.width = extent->width,
                             .height = extent->height,
                             .layers = extent->layers,
                             .levels = extent->levels};
    return passes_reduced_map_bytes(&map, extent->format) / lobe_format_size(extent->format);
}

uint32_t passes_mixture_rows(const mixture_extent *extent) {
    return (uint32_t)((texel_count(extent) + MIXTURE_FILE_ROW - 1) / MIXTURE_FILE_ROW);
}

static size_t row_bytes(const mixture_extent *extent) {
    return (size_t)passes_mixture_rows(extent) * MIXTURE_FILE_ROW *
           lobe_format_size(extent->format);
}

static size_t content_bytes(const mixture_extent *extent) {
    return sizeof(struct moment_binning_constants) + row_bytes(extent);
}

static file_header header_of(uint64_t key, const mixture_extent *extent, const uint8_t *content) {
    file_header header = {
        .name = "lobe mix",
        .byte_order = 0x01020304,
        .version = MIXTURE_FILE_VERSION,
        .key = key,
        .format = (uint32_t)extent->format,
        .width = extent->width,
        .height = extent->height,
        .layers = extent->layers,
        .levels = extent->levels,
        .rows = passes_mixture_rows(extent),
    };
    header.checksum = passes_digest_bytes(0, content, content_bytes(extent));
    return header;
}

/// The caller frees it with lobe_release. NULL if out of memory.
static char *path_of(const lobe_host *host, const char *folder, uint64_t key) {
    const size_t size = strlen(folder) + 32;
    char *path = lobe_allocate(lobe_host_allocator(host), size, 1);
    if (path)
        snprintf(path, size, "%s/%s.mixture", folder, passes_digest_print(key).text);
    return path;
}

static bool is_whole(const uint8_t *file, size_t size, uint64_t key, const mixture_extent *extent) {
    if (size != sizeof(file_header) + content_bytes(extent))
        return false;
    const file_header expected = header_of(key, extent, file + sizeof expected);
    return memcmp(file, &expected, sizeof expected) == 0;
}

static bool load_file(const char *path, uint64_t key, const mixture_extent *extent,
                      const lobe_host *host, mixture_image *image) {
    const lobe_host silent = {.allocator = lobe_host_allocator(host)};
    size_t size;
    if (lobe_file_read(path, NULL, &silent, &image->file, &size) != LOBE_OK)
        return false;
    if (!is_whole(image->file, size, key, extent)) {
        passes_mixture_image_free(image);
        return false;
    }
    uint8_t *content = image->file + sizeof(file_header);
    memcpy(&image->bins, content, sizeof image->bins);
    image->rows = (lobe_image){extent->format, MIXTURE_FILE_ROW, passes_mixture_rows(extent),
                               content + sizeof image->bins};
    return true;
}

bool passes_mixture_file_load(const char *folder, uint64_t key, const mixture_extent *extent,
                              const lobe_host *host, mixture_image *image) {
    *image = (mixture_image){0};
    char *path = path_of(host, folder, key);
    const bool there = path && access(path, F_OK) == 0;
    const bool loaded = there && load_file(path, key, extent, host, image);
    if (there && !loaded)
        lobe_host_log(host, LOBE_LOG_NOTICE,
                      "%s: not a cached mixture, or damaged: it will be replaced", path);
    lobe_release(path);
    return loaded;
}

void passes_mixture_image_free(mixture_image *image) {
    lobe_release(image->file);
    *image = (mixture_image){0};
}

static lobe_result save_file(const char *path, uint64_t key, const mixture_extent *extent,
                             const struct moment_binning_constants *bins, const void *texels,
                             const lobe_host *host) {
    const lobe_host silent = {.allocator = lobe_host_allocator(host)};
    const size_t size = sizeof(file_header) + content_bytes(extent);
    uint8_t *file = lobe_allocate(silent.allocator, size, 1);
    if (!file)
        return LOBE_ERROR_OUT_OF_MEMORY;
    uint8_t *content = file + sizeof(file_header);
    memcpy(content, bins, sizeof *bins);
    memcpy(content + sizeof *bins, texels, texel_count(extent) * lobe_format_size(extent->format));
    const file_header header = header_of(key, extent, content);
    memcpy(file, &header, sizeof header);
    const lobe_result result = lobe_file_write(path, file, size, &silent);
    lobe_release(file);
    return result;
}

void passes_mixture_file_save(const char *folder, uint64_t key, const mixture_extent *extent,
                              const struct moment_binning_constants *bins, const void *texels,
                              const lobe_host *host) {
    char *path = path_of(host, folder, key);
    if (!path || save_file(path, key, extent, bins, texels, host) != LOBE_OK)
        lobe_host_log(host, LOBE_LOG_WARNING, "%s: cannot save the fitted mixture in this folder",
                      folder);
    lobe_release(path);
}
