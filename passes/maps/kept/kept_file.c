#include "passes/maps/kept/kept_file.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <lobe/file.h>

#include "passes/context/digest.h"
#include "passes/context/saving_log.h"
#include "passes/maps/level_reduction.h"

/// All members are compared with what a file must have; then come the buffers and the images' rows.
typedef struct file_header {
    char name[8];
    uint32_t byte_order;
    uint32_t version; ///< of this header
    uint64_t key;
    uint64_t layout; ///< digest
    uint64_t bytes;  ///< of what follows
    uint64_t checksum;
} file_header;

_Static_assert(sizeof(file_header) == 48, "file_header has no gaps");

static size_t image_bytes(const kept_image *image) {
    const reduced_map map = {.width = image->width,
                             .height = image->height,
                             .layers = image->layers,
                             .levels = image->levels};
    return passes_reduced_map_bytes(&map, image->format);
}

uint32_t passes_kept_rows(const kept_image *image) {
    const size_t row = KEPT_FILE_ROW * lobe_format_size(image->format);
    return (uint32_t)((image_bytes(image) + row - 1) / row);
}

static size_t row_bytes(const kept_image *image) {
    return (size_t)passes_kept_rows(image) * KEPT_FILE_ROW * lobe_format_size(image->format);
}

/// Of a buffer in a file, so that what follows lies well aligned.
static size_t buffer_bytes(const kept_layout *layout, uint32_t buffer) {
    return ((size_t)layout->buffer_bytes[buffer] + 15) / 16 * 16;
}

uint64_t passes_kept_bytes(const kept_layout *layout) {
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < layout->buffer_count; i++)
        bytes += buffer_bytes(layout, i);
    for (uint32_t i = 0; i < layout->image_count; i++)
        bytes += row_bytes(&layout->images[i]);
    return bytes;
}

static uint64_t layout_digest(const kept_layout *layout) {
    uint64_t digest = layout->image_count;
    for (uint32_t i = 0; i < layout->buffer_count; i++)
        digest = passes_digest(digest, layout->buffer_bytes[i]);
    for (uint32_t i = 0; i < layout->image_count; i++) {
        const kept_image *image = &layout->images[i];
        const uint64_t numbers[] = {(uint64_t)image->format, image->width, image->height,
                                    image->layers, image->levels};
        digest = passes_digest_bytes(digest, numbers, sizeof numbers);
    }
    // Shares, and tiles, are as large as each other: a file that was renamed must not pass for
    // another one.
    if (layout->shares > 0)
        digest = passes_digest(digest, (uint64_t)layout->share << 32 | layout->shares);
    if (layout->tiles > 0)
        digest = passes_digest(digest, (uint64_t)layout->tile << 32 | layout->tiles);
    return digest;
}

static file_header header_of(uint64_t key, const kept_layout *layout, const uint8_t *content) {
    const size_t bytes = passes_kept_bytes(layout);
    return (file_header){.name = "lobe map",
                         .byte_order = 0x01020304,
                         .version = 1,
                         .key = key,
                         .layout = layout_digest(layout),
                         .bytes = bytes,
                         .checksum = passes_digest_bytes(0, content, bytes)};
}

char *passes_kept_file_path(const char *folder, uint64_t key, const kept_layout *layout,
                            const lobe_host *host) {
    char number[40] = "";
    if (layout->tiles > 0)
        snprintf(number, sizeof number, "-tile-%u-of-%u", layout->tile, layout->tiles);
    else if (layout->shares > 0)
        snprintf(number, sizeof number, "-%u-of-%u", layout->share, layout->shares);
    const size_t size = strlen(folder) + strlen(layout->what) + strlen(number) + 24;
    char *path = lobe_allocate(lobe_host_allocator(host), size, 1);
    if (path)
        snprintf(path, size, "%s/%s.%s%s", folder, passes_digest_print(key).text, layout->what,
                 number);
    return path;
}

static bool is_whole(const uint8_t *file, size_t size, uint64_t key, const kept_layout *layout) {
    if (size != sizeof(file_header) + passes_kept_bytes(layout))
        return false;
    const file_header expected = header_of(key, layout, file + sizeof expected);
    return memcmp(file, &expected, sizeof expected) == 0;
}

static bool load_file(const char *path, uint64_t key, const kept_layout *layout,
                      const lobe_host *host, kept_content *content) {
    const lobe_host silent = {.allocator = lobe_host_allocator(host)};
    size_t size;
    if (lobe_file_read(path, NULL, &silent, &content->file, &size) != LOBE_OK)
        return false;
    if (!is_whole(content->file, size, key, layout)) {
        passes_kept_content_free(content);
        return false;
    }
    uint8_t *next = content->file + sizeof(file_header);
    for (uint32_t i = 0; i < layout->buffer_count; i++) {
        content->buffers[i] = next;
        next += buffer_bytes(layout, i);
    }
    for (uint32_t i = 0; i < layout->image_count; i++) {
        const kept_image *image = &layout->images[i];
        content->rows[i] =
            (lobe_image){image->format, KEPT_FILE_ROW, passes_kept_rows(image), next};
        next += row_bytes(image);
    }
    return true;
}

bool passes_kept_file_is_there(const char *folder, uint64_t key, const kept_layout *layout,
                               const lobe_host *host) {
    char *path = passes_kept_file_path(folder, key, layout, host);
    const bool there = path && access(path, F_OK) == 0;
    lobe_release(path);
    return there;
}

bool passes_kept_file_load(const char *folder, uint64_t key, const kept_layout *layout,
                           const lobe_host *host, kept_content *content) {
    *content = (kept_content){0};
    char *path = passes_kept_file_path(folder, key, layout, host);
    const bool there = path && access(path, F_OK) == 0;
    const bool loaded = there && load_file(path, key, layout, host, content);
    if (there && !loaded)
        lobe_host_log(host, LOBE_LOG_NOTICE, "%s: not a cached %s, or damaged: it will be replaced",
                      path, layout->what);
    lobe_release(path);
    return loaded;
}

void passes_kept_file_decline(const char *folder, uint64_t key, const kept_layout *layout,
                              const char *why, const lobe_host *host) {
    char *path = passes_kept_file_path(folder, key, layout, host);
    lobe_host_log(host, LOBE_LOG_NOTICE, "%s: %s: it will be replaced", path ? path : folder, why);
    lobe_release(path);
}

void passes_kept_content_free(kept_content *content) {
    lobe_release(content->file);
    *content = (kept_content){0};
}

static lobe_result save_file(const char *path, uint64_t key, const kept_layout *layout,
                             const void *const *images, const void *const *buffers,
                             const lobe_host *host) {
    const size_t size = sizeof(file_header) + passes_kept_bytes(layout);
    uint8_t *file = lobe_allocate(lobe_host_allocator(host), size, 1);
    if (!file)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", path);
    uint8_t *content = file + sizeof(file_header), *next = content;
    for (uint32_t i = 0; i < layout->buffer_count; i++) {
        memcpy(next, buffers[i], layout->buffer_bytes[i]);
        next += buffer_bytes(layout, i);
    }
    for (uint32_t i = 0; i < layout->image_count; i++) {
        memcpy(next, images[i], image_bytes(&layout->images[i]));
        next += row_bytes(&layout->images[i]);
    }
    const file_header header = header_of(key, layout, content);
    memcpy(file, &header, sizeof header);
    const lobe_result result = lobe_file_write(path, file, size, host);
    lobe_release(file);
    return result;
}

bool passes_kept_file_save(const char *folder, uint64_t key, const kept_layout *layout,
                           const void *const *images, const void *const *buffers,
                           const lobe_host *host) {
    saving_log log = {host, layout->what};
    const lobe_host saving = passes_saving_host(&log);
    char *path = passes_kept_file_path(folder, key, layout, host);
    if (!path)
        lobe_host_fail(&saving, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", folder);
    const bool saved = path && save_file(path, key, layout, images, buffers, &saving) == LOBE_OK;
    lobe_release(path);
    return saved;
}

void passes_kept_file_remove(const char *folder, uint64_t key, const kept_layout *layout,
                             const lobe_host *host) {
    char *path = passes_kept_file_path(folder, key, layout, host);
    if (path)
        remove(path);
    lobe_release(path);
}
