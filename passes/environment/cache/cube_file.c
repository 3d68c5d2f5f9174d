#include "passes/environment/cache/cube_file.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/// Increment it whenever the same environment is filtered differently: old files are then no longer
/// found.
#define CACHE_VERSION 1

static const char key_attribute[] = "environmentHash";
static const char checksum_attribute[] = "texelChecksum";

// ---------------------------------------------------------------------------------------------
// Hashes

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number
/// generators", Fig. 5): every input bit moves every output bit.
static uint64_t mix(uint64_t hash, uint64_t value) {
    uint64_t z = (hash ^ value) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31) ^ (hash << 17 | hash >> 47);
}

static uint64_t mix_texels(uint64_t hash, const float *texels, size_t count) {
    for (size_t texel = 0; texel < count; texel++) {
        uint64_t words[2];
        memcpy(words, texels + 4 * texel, sizeof words);
        hash = mix(mix(hash, words[0]), words[1]);
    }
    return hash;
}

uint64_t passes_cube_file_key(const lobe_environment *environment, uint32_t size,
                              lobe_environment_map map) {
    const lobe_image *image = &environment->image;
    uint64_t hash = mix(CACHE_VERSION, size);
    hash = mix(hash, (uint64_t)map);
    hash = mix(hash, (uint64_t)environment->layout);
    hash = mix(hash, (uint64_t)image->width << 32 | image->height);
    return mix_texels(hash, image->texels, (size_t)image->width * image->height);
}

static uint64_t checksum_of(const cube_image *cube) {
    return mix_texels(0, cube->texels, passes_cube_image_texels(cube));
}

typedef struct number_as_text {
    char text[17];
} number_as_text;

static number_as_text hexadecimal(uint64_t number) {
    number_as_text result;
    snprintf(result.text, sizeof result.text, "%016" PRIx64, number);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Files

/// The caller frees it with lobe_release. NULL if out of memory.
static char *path_of(const lobe_allocator *allocator, const char *folder, uint64_t key) {
    size_t size = strlen(folder) + 32;
    char *path = lobe_allocate(allocator, size, 1);
    if (path)
        snprintf(path, size, "%s/%s.exr", folder, hexadecimal(key).text);
    return path;
}

static bool has_number(const lobe_exr_contents *contents, const char *name, uint64_t number) {
    const lobe_exr_attribute *attribute = lobe_exr_find_attribute(contents, name, LOBE_EXR_TEXT);
    return attribute && strcmp(attribute->text, hexadecimal(number).text) == 0;
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
    const lobe_host silent = {.allocator = lobe_host_allocator(host)};
    const number_as_text texts[] = {hexadecimal(key), hexadecimal(checksum_of(cube))};
    const lobe_exr_attribute attributes[] = {
        {.name = key_attribute, .type = LOBE_EXR_TEXT, .text = texts[0].text},
        {.name = checksum_attribute, .type = LOBE_EXR_TEXT, .text = texts[1].text},
    };
    return passes_cube_image_write(path, cube, attributes, 2, &silent);
}

void passes_cube_file_save(const char *folder, uint64_t key, const cube_image *cube,
                           const lobe_host *host) {
    char *path = path_of(lobe_host_allocator(host), folder, key);
    if (!path || save_file(path, key, cube, host) != LOBE_OK)
        lobe_host_log(host, LOBE_LOG_WARNING,
                      "%s: cannot save the filtered environment in this folder", folder);
    lobe_release(path);
}
