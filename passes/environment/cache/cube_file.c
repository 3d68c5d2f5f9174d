#include "passes/environment/cache/cube_file.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "passes/context/digest.h"
#include "passes/context/saving_log.h"

/// Increment it whenever the same environment is filtered differently: old files are then no longer
/// found.
#define CACHE_VERSION 3

static const char key_attribute[] = "environmentHash";
static const char checksum_attribute[] = "texelChecksum";

// ---------------------------------------------------------------------------------------------
// Hashes

uint64_t passes_cube_file_key(const lobe_environment *environment, uint32_t size,
                              lobe_environment_map map) {
    const lobe_image *image = &environment->image;
    uint64_t hash = passes_digest(CACHE_VERSION, size);
    hash = passes_digest(hash, (uint64_t)map);
    hash = passes_digest(hash, (uint64_t)environment->layout);
    hash = passes_digest(hash, (uint64_t)image->width << 32 | image->height);
    return passes_digest_bytes(hash, image->texels,
                               4 * sizeof(float) * image->width * image->height);
}

static uint64_t checksum_of(const cube_image *cube) {
    return passes_digest_bytes(0, cube->texels,
                               4 * sizeof *cube->texels * passes_cube_image_texels(cube));
}

// ---------------------------------------------------------------------------------------------
// Files

/// The caller frees it with lobe_release. NULL if out of memory.
static char *path_of(const lobe_allocator *allocator, const char *folder, uint64_t key) {
    size_t size = strlen(folder) + 32;
    char *path = lobe_allocate(allocator, size, 1);
    if (path)
        snprintf(path, size, "%s/%s.exr", folder, passes_digest_print(key).text);
    return path;
}

static bool has_number(const lobe_exr_contents *contents, const char *name, uint64_t number) {
    const lobe_exr_attribute *attribute = lobe_exr_find_attribute(contents, name, LOBE_EXR_TEXT);
    return attribute && strcmp(attribute->text, passes_digest_print(number).text) == 0;
}

static bool load_file(const char *path, uint64_t key, uint32_t width, const lobe_host *host,
                      cube_image *cube) {
    const lobe_host silent = {.allocator = lobe_host_allocator(host)};
    lobe_exr_contents contents;
    if (lobe_exr_read_contents(path, NULL, &silent, &contents) != LOBE_OK)
        return false;
    bool whole = has_number(&contents, key_attribute, key) &&
                 passes_cube_image_from(path, &contents, &silent, cube) == LOBE_OK;
    whole = whole && cube->width == width &&
            has_number(&contents, checksum_attribute, checksum_of(cube));
    if (!whole)
        passes_cube_image_free(cube);
    lobe_exr_contents_free(&contents);
    return whole;
}

bool passes_cube_file_load(const char *folder, uint64_t key, uint32_t width, const lobe_host *host,
                           cube_image *cube) {
    *cube = (cube_image){0};
    char *path = path_of(lobe_host_allocator(host), folder, key);
    bool there = path && access(path, F_OK) == 0;
    bool loaded = there && load_file(path, key, width, host, cube);
    if (there && !loaded)
        lobe_host_log(host, LOBE_LOG_NOTICE,
                      "%s: not a cached environment, or damaged: it will be replaced", path);
    lobe_release(path);
    return loaded;
}

static lobe_result save_file(const char *path, uint64_t key, const cube_image *cube,
                             const lobe_host *host) {
    const digest_text texts[] = {passes_digest_print(key), passes_digest_print(checksum_of(cube))};
    const lobe_exr_attribute attributes[] = {
        {.name = key_attribute, .type = LOBE_EXR_TEXT, .text = texts[0].text},
        {.name = checksum_attribute, .type = LOBE_EXR_TEXT, .text = texts[1].text},
    };
    return passes_cube_image_write(path, cube, attributes, 2, host);
}

bool passes_cube_file_save(const char *folder, uint64_t key, const cube_image *cube,
                           const lobe_host *host) {
    saving_log log = {host, "filtered environment"};
    const lobe_host saving = passes_saving_host(&log);
    char *path = path_of(lobe_host_allocator(host), folder, key);
    if (!path)
        lobe_host_fail(&saving, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", folder);
    const bool saved = path && save_file(path, key, cube, &saving) == LOBE_OK;
    lobe_release(path);
    return saved;
}
