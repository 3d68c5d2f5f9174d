#include "scenes/material/file_name.h"

#include <ctype.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

// Longer names, which common file systems do not allow, are not recognised.
enum { MAXIMUM_LENGTH = 512, MAXIMUM_WORDS = 64 };

typedef struct map_word {
    const char *word;
    material_map map;
} map_word;

// One word, or two consecutive words joined.
static const map_word map_words[] = {
    {"albedo", MATERIAL_MAP_ALBEDO},
    {"base", MATERIAL_MAP_ALBEDO},
    {"basecolor", MATERIAL_MAP_ALBEDO},
    {"basecolour", MATERIAL_MAP_ALBEDO},
    {"col", MATERIAL_MAP_ALBEDO},
    {"color", MATERIAL_MAP_ALBEDO},
    {"colour", MATERIAL_MAP_ALBEDO},
    {"diff", MATERIAL_MAP_ALBEDO},
    {"diffuse", MATERIAL_MAP_ALBEDO},
    {"nor", MATERIAL_MAP_NORMAL},
    {"norgl", MATERIAL_MAP_NORMAL},
    {"norm", MATERIAL_MAP_NORMAL},
    {"normal", MATERIAL_MAP_NORMAL},
    {"normalgl", MATERIAL_MAP_NORMAL},
    {"normalmap", MATERIAL_MAP_NORMAL},
    {"normalogl", MATERIAL_MAP_NORMAL},
    {"normalopengl", MATERIAL_MAP_NORMAL},
    {"normals", MATERIAL_MAP_NORMAL},
    {"nrm", MATERIAL_MAP_NORMAL},
    {"nordx", MATERIAL_MAP_NORMAL_DIRECTX},
    {"normaldirectx", MATERIAL_MAP_NORMAL_DIRECTX},
    {"normaldx", MATERIAL_MAP_NORMAL_DIRECTX},
    {"rough", MATERIAL_MAP_ROUGHNESS},
    {"roughness", MATERIAL_MAP_ROUGHNESS},
    {"metal", MATERIAL_MAP_METALLIC},
    {"metallic", MATERIAL_MAP_METALLIC},
    {"metalness", MATERIAL_MAP_METALLIC},
    {"metallicroughness", MATERIAL_MAP_METALLIC_ROUGHNESS},
    {"arm", MATERIAL_MAP_OCCLUSION_ROUGHNESS_METALLIC},
    {"orm", MATERIAL_MAP_OCCLUSION_ROUGHNESS_METALLIC},
    {"ambientocclusion", MATERIAL_MAP_OCCLUSION},
    {"ao", MATERIAL_MAP_OCCLUSION},
    {"occlusion", MATERIAL_MAP_OCCLUSION},
    {"emission", MATERIAL_MAP_EMISSIVE},
    {"emissive", MATERIAL_MAP_EMISSIVE},
    {"depth", MATERIAL_MAP_DISPLACEMENT},
    {"disp", MATERIAL_MAP_DISPLACEMENT},
    {"displacement", MATERIAL_MAP_DISPLACEMENT},
    {"height", MATERIAL_MAP_DISPLACEMENT},
};

static material_map look_up(const char *word) {
    for (size_t i = 0; i < sizeof map_words / sizeof *map_words; i++)
        if (strcmp(map_words[i].word, word) == 0)
            return map_words[i].map;
    return MATERIAL_MAP_COUNT;
}

static const char *extension(const char *name) {
    const char *point = strrchr(name, '.');
    return point ? point : name + strlen(name);
}

// Splits a name into lower-case words of letters and digits, each terminated by 0 in `text`; a word
// takes at most twice its length there. Returns their number.
static size_t split(const char *name, char text[2 * MAXIMUM_LENGTH + 1],
                    const char *words[MAXIMUM_WORDS]) {
    size_t count = 0;
    unsigned char before = '_';
    for (const char *end = extension(name); name < end && count < MAXIMUM_WORDS; name++) {
        unsigned char letter = (unsigned char)*name;
        bool within = isalnum(letter) && isalnum(before) && !(isupper(letter) && islower(before));
        if (!within && isalnum(before))
            *text++ = 0;
        if (!within && isalnum(letter))
            words[count++] = text;
        if (isalnum(letter))
            *text++ = (char)tolower(letter);
        before = letter;
    }
    *text = 0;
    return count;
}

material_map scenes_material_file_map(const char *name) {
    char text[2 * MAXIMUM_LENGTH + 1], joined[2 * MAXIMUM_LENGTH + 1];
    const char *words[MAXIMUM_WORDS];
    if (strlen(name) > MAXIMUM_LENGTH)
        return MATERIAL_MAP_COUNT;
    for (size_t i = split(name, text, words); i-- > 0;) {
        snprintf(joined, sizeof joined, "%s%s", i > 0 ? words[i - 1] : "", words[i]);
        material_map pair = look_up(joined), single = look_up(words[i]);
        if (pair != MATERIAL_MAP_COUNT)
            return pair;
        if (single != MATERIAL_MAP_COUNT)
            return single;
    }
    return MATERIAL_MAP_COUNT;
}

bool scenes_material_file_is_readable(const char *name) {
    const char *end = extension(name);
    return strcasecmp(end, ".png") == 0 || strcasecmp(end, ".jpg") == 0 ||
           strcasecmp(end, ".jpeg") == 0;
}

bool scenes_material_file_is_other_image(const char *name) {
    static const char *const extensions[] = {".exr", ".tif", ".tiff", ".tga",  ".bmp",
                                             ".hdr", ".dds", ".ktx2", ".webp", ".psd"};
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++)
        if (strcasecmp(extension(name), extensions[i]) == 0)
            return true;
    return false;
}
