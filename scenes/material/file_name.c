#include "scenes/material/file_name.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

// ---------------------------------------------------------------------------------------------
// Splitting a name

static const char *extension(const char *name) {
    const char *point = strrchr(name, '.');
    return point ? point : name + strlen(name);
}

/// The length of a word without a number at its end, of at most two digits, or a resolution: "3",
/// "16", "2k". Longer numbers belong to names of materials ("Metal053").
static size_t length_without_number(const char *word) {
    size_t length = strlen(word), end = length;
    if (end > 1 && word[end - 1] == 'k' && isdigit((unsigned char)word[end - 2]))
        end--;
    size_t digits = 0;
    while (end > 0 && isdigit((unsigned char)word[end - 1]))
        end--, digits++;
    return digits > 0 && digits <= 2 ? end : length;
}

/// Whether the whole word consists of known words; `first` receives the length of the first. The
/// longest comes first: "normals" before "normal".
static bool is_made_of_known_words(const char *word, size_t length, size_t *first) {
    // "OcclusionRoughnessMetallic" has 26 letters. Longer words could be split in too many ways.
    if (length > 40)
        return false;
    for (size_t part = length; part > 0; part--) {
        size_t next;
        if (scenes_material_map_word(word, part) &&
            (part == length || is_made_of_known_words(word + part, length - part, &next))) {
            *first = part;
            return true;
        }
    }
    return false;
}

static char *add_word(material_name *split, char *text, const char *word, size_t length,
                      bool joined) {
    if (split->count >= MATERIAL_NAME_WORDS)
        return text;
    split->words[split->count] = text;
    split->joined[split->count++] = joined;
    memcpy(text, word, length);
    text[length] = 0;
    return text + length + 1;
}

/// A word between punctuation or changes of case.
static char *add_words(material_name *split, char *text, const char *word, bool joined) {
    size_t length = length_without_number(word), part;
    if (!is_made_of_known_words(word, length, &part))
        return add_word(split, text, word, strlen(word), joined);
    while (length > 0 && is_made_of_known_words(word, length, &part)) {
        text = add_word(split, text, word, part, joined);
        word += part;
        length -= part;
        joined = true;
    }
    return text;
}

void scenes_material_name_split(const char *name, material_name *split) {
    char word[MATERIAL_NAME_LENGTH + 1], *text = split->text;
    size_t length = 0;
    bool joined = false;
    unsigned char before = '_';
    split->count = 0;
    if (strlen(name) > MATERIAL_NAME_LENGTH)
        return;
    for (const char *end = extension(name);; name++) {
        unsigned char letter = name < end ? (unsigned char)*name : '_';
        bool within = isalnum(letter) && isalnum(before) && !(isupper(letter) && islower(before));
        if (!within && length > 0) {
            word[length] = 0;
            text = add_words(split, text, word, joined);
            length = 0;
            joined = isalnum(letter);
        }
        if (isalnum(letter))
            word[length++] = (char)tolower(letter);
        else
            joined = false;
        before = letter;
        if (name >= end)
            return;
    }
}

// ---------------------------------------------------------------------------------------------
// Parsing it

static material_file_content unknown_content(size_t first) {
    const material_map none = MATERIAL_MAP_COUNT;
    return (material_file_content){
        .map = none, .channels = {none, none, none, none}, .first = first};
}

static material_file_content packed_content(const char *letters, size_t first) {
    material_file_content content = unknown_content(first);
    for (size_t i = 0; letters[i]; i++)
        content.channels[i] = scenes_material_map_channel(letters[i]);
    return content;
}

static material_file_content map_content(material_map map, size_t first) {
    material_file_content content = unknown_content(first);
    content.map = map;
    return content;
}

static const map_word *word_at(const material_name *name, size_t i) {
    return scenes_material_map_word(name->words[i], strlen(name->words[i]));
}

static bool is_value(const map_word *word) {
    return word && word->kind == WORD_MAP && word->map >= MATERIAL_MAP_OCCLUSION;
}

/// The word before `i` that is not a filler; `first` - 1 (which may wrap) if there is none.
static size_t word_before(const material_name *name, size_t first, size_t i) {
    do
        i--;
    while (i + 1 > first && word_at(name, i) && word_at(name, i)->kind == WORD_FILLER);
    return i;
}

/// The channel of a value in a file of two: Unity has metallic in red and smoothness in alpha, glTF
/// occlusion, roughness and metallic in this order.
static int channel_in_pair(material_map map, bool with_gloss) {
    switch (map) {
    case MATERIAL_MAP_GLOSS:
        return 3;
    case MATERIAL_MAP_METALLIC:
        return with_gloss ? 0 : 2;
    case MATERIAL_MAP_OCCLUSION:
        return 0;
    case MATERIAL_MAP_ROUGHNESS:
        return 1;
    default:
        return 2;
    }
}

/// Two words for values that end at word `i`: "metallicRoughness", "Metallic_Smoothness". An
/// abbreviation must be joined to the other, or the material's name may end with it ("metal_rough",
/// "RustyMetalRoughness").
static bool parse_pair(const material_name *name, size_t first, size_t i,
                       material_file_content *content) {
    const size_t at = word_before(name, first, i);
    if (i == first || at + 1 == first)
        return false;
    const map_word *a = word_at(name, at), *b = word_at(name, i);
    const bool joined = name->joined[i] && (at == first || !a || a->map != MATERIAL_MAP_METALLIC);
    const bool specular = a && strncmp(a->word, "spec", 4) == 0;
    *content = unknown_content(at);
    if (specular && b->map == MATERIAL_MAP_GLOSS && joined) {
        content->channels[3] = MATERIAL_MAP_GLOSS; // Unity's SpecularSmoothness
        return true;
    }
    if (!is_value(a) || a->map == b->map || !(joined || (a->full && b->full)))
        return false;
    const bool gloss = a->map == MATERIAL_MAP_GLOSS || b->map == MATERIAL_MAP_GLOSS;
    content->channels[channel_in_pair(a->map, gloss)] = a->map;
    content->channels[channel_in_pair(b->map, gloss)] = b->map;
    return true;
}

/// Three or four different values in a row are the channels in this order.
static bool parse_row(const material_name *name, size_t first, size_t i,
                      material_file_content *content) {
    size_t words[4], count = 0;
    unsigned seen = 0;
    for (size_t at = i; count < 4; at = word_before(name, first, at)) {
        if (at + 1 == first || at >= name->count || !is_value(word_at(name, at)) ||
            (seen >> word_at(name, at)->map & 1))
            break;
        seen |= 1u << word_at(name, at)->map;
        words[count++] = at;
    }
    if (count < 3)
        return false;
    *content = unknown_content(words[count - 1]);
    for (size_t k = 0; k < count; k++)
        content->channels[k] = word_at(name, words[count - 1 - k])->map;
    return true;
}

/// "base_color", "ambient_occlusion": two words that are one of the list.
static bool parse_compound(const material_name *name, size_t i, material_file_content *content) {
    char both[2 * MATERIAL_NAME_LENGTH + 2];
    snprintf(both, sizeof both, "%s%s", name->words[i - 1], name->words[i]);
    const map_word *pair = scenes_material_map_word(both, strlen(both));
    const bool found = pair && pair->kind == WORD_MAP;
    if (found)
        *content = map_content(pair->map, i - 1);
    return found;
}

/// "emissive_color", "specular_colour": the word before says which colour.
static bool parse_colour(const material_name *name, size_t i, material_file_content *content) {
    const map_word *before = word_at(name, i - 1);
    if (!before || (before->kind != WORD_UNUSED && before->map != MATERIAL_MAP_EMISSIVE &&
                    before->map != MATERIAL_MAP_ALBEDO))
        return false;
    *content = map_content(before->map, i - 1);
    content->unused = before->kind == WORD_UNUSED ? before->word : NULL;
    return true;
}

/// A word that names a map, with those before it that belong to it.
static material_file_content parse_map(const material_name *name, size_t first, size_t i) {
    const map_word *word = word_at(name, i);
    material_file_content content;
    if (is_value(word) &&
        (parse_row(name, first, i, &content) || parse_pair(name, first, i, &content)))
        return content;
    if (i > first && parse_compound(name, i, &content))
        return content;
    if (i > first && word->map == MATERIAL_MAP_ALBEDO && parse_colour(name, i, &content))
        return content;
    return map_content(word->map, i);
}

/// "normal_dx": a word for the direction of Y counts after one for normals.
static bool parse_direction(const material_name *name, size_t first, size_t i,
                            material_file_content *content) {
    const size_t at = word_before(name, first, i);
    if (i == first || at + 1 == first)
        return false;
    const map_word *word = word_at(name, at);
    if (!word || word->kind != WORD_MAP || word->map != MATERIAL_MAP_NORMAL)
        return false;
    if (strcmp(name->words[i], "x") == 0 && strcmp(name->words[i - 1], "direct") != 0)
        return false;
    const bool down = word_at(name, i)->kind == WORD_DIRECTX;
    *content = map_content(down ? MATERIAL_MAP_NORMAL_DIRECTX : MATERIAL_MAP_NORMAL, at);
    return true;
}

static bool parse_alpha(const material_name *name, size_t first, size_t i,
                        material_file_content *content) {
    const map_word *word = i > first ? word_at(name, i - 1) : NULL;
    if (!word || word->kind != WORD_MAP || word->map != MATERIAL_MAP_ALBEDO)
        return false;
    *content = parse_map(name, first, i - 1);
    return true;
}

static bool parse_mask_map(const material_name *name, size_t first, size_t i,
                           material_file_content *content) {
    const bool found =
        i > first && strcmp(name->words[i], "map") == 0 && strcmp(name->words[i - 1], "mask") == 0;
    if (found)
        *content = packed_content("mo-g", i - 1);
    return found;
}

/// "T_Brick_N".
static bool parse_unreal(const material_name *name, material_file_content *content) {
    const size_t last = name->count - 1;
    if (name->count < 2 || strcmp(name->words[0], "t") != 0 || strlen(name->words[last]) != 1)
        return false;
    *content = map_content(scenes_material_map_letter(*name->words[last]), last);
    return content->map != MATERIAL_MAP_COUNT;
}

static bool parse_at(const material_name *name, size_t first, size_t i,
                     material_file_content *content) {
    const map_word *word = word_at(name, i);
    if (!word)
        return false;
    switch (word->kind) {
    case WORD_MAP:
        *content = parse_map(name, first, i);
        return true;
    case WORD_PACKED:
        *content = packed_content(word->channels, i);
        return true;
    case WORD_FILLER:
        return parse_mask_map(name, first, i, content);
    case WORD_OPENGL:
    case WORD_DIRECTX:
        return parse_direction(name, first, i, content);
    case WORD_ALPHA:
        if (parse_alpha(name, first, i, content))
            return true;
        break;
    default:
        break;
    }
    *content = unknown_content(i);
    content->unused = word->word;
    return true;
}

material_file_content scenes_material_name_parse(const material_name *name, size_t first) {
    material_file_content content = unknown_content(name->count);
    content.end = name->count;
    if (name->count > first && parse_unreal(name, &content))
        return content;
    for (size_t i = name->count; i-- > first;)
        if (parse_at(name, first, i, &content)) {
            content.end = i + 1;
            return content;
        }
    return content;
}

bool scenes_material_file_is_packed(const material_file_content *content) {
    for (int i = 0; i < 4; i++)
        if (content->channels[i] != MATERIAL_MAP_COUNT)
            return true;
    return false;
}

bool scenes_material_file_is_map(const material_file_content *content) {
    return content->map != MATERIAL_MAP_COUNT || scenes_material_file_is_packed(content);
}

bool scenes_material_file_is_gltf(const material_file_content *content) {
    return content->channels[1] == MATERIAL_MAP_ROUGHNESS &&
           content->channels[2] == MATERIAL_MAP_METALLIC &&
           (content->channels[0] == MATERIAL_MAP_OCCLUSION ||
            content->channels[0] == MATERIAL_MAP_COUNT);
}

// ---------------------------------------------------------------------------------------------
// Extensions

bool scenes_material_file_is_readable(const char *name) {
    const char *end = extension(name);
    return strcasecmp(end, ".png") == 0 || strcasecmp(end, ".jpg") == 0 ||
           strcasecmp(end, ".jpeg") == 0 || scenes_material_file_is_exr(name);
}

bool scenes_material_file_is_exr(const char *name) {
    return strcasecmp(extension(name), ".exr") == 0;
}

bool scenes_material_file_is_other_image(const char *name) {
    static const char *const extensions[] = {".tif", ".tiff", ".tga",  ".bmp", ".hdr",
                                             ".dds", ".ktx2", ".webp", ".psd"};
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++)
        if (strcasecmp(extension(name), extensions[i]) == 0)
            return true;
    return false;
}
