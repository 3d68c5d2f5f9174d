#include "tools/scenes/ply_header.h"

#include <stdint.h>
#include <string.h>

enum { MAXIMUM_LINE = 256, MAXIMUM_WORDS = 5 };

typedef struct header_reader {
    const char *name;
    const lobe_host *host;
    text_cursor *cursor;
    ply_header *header;
    size_t line;
    char text[MAXIMUM_LINE + 1]; // the line, split into words
    const char *words[MAXIMUM_WORDS];
    size_t word_count;
    bool formatted, vertices, polygons; // seen so far
} header_reader;

static lobe_result fail(const header_reader *reader, lobe_result result, const char *cause) {
    return lobe_host_fail(reader->host, result, "%s: header, line %zu: %s", reader->name,
                          reader->line, cause);
}

// No statement has more words than MAXIMUM_WORDS; further words, as in comments, are ignored.
static void split(header_reader *reader) {
    char *at = reader->text;
    reader->word_count = 0;
    while (reader->word_count < MAXIMUM_WORDS) {
        at += strspn(at, " \t\r");
        if (!*at)
            break;
        reader->words[reader->word_count++] = at;
        at += strcspn(at, " \t\r");
        if (*at)
            *at++ = 0;
    }
}

static lobe_result next_line(header_reader *reader) {
    text_cursor *cursor = reader->cursor;
    size_t left = (size_t)(cursor->end - cursor->at);
    const char *end = memchr(cursor->at, '\n', left);
    reader->line++;
    if (!end)
        return fail(reader, LOBE_ERROR_MALFORMED, "the file ends within its header");
    size_t length = (size_t)(end - cursor->at);
    size_t kept = length < MAXIMUM_LINE ? length : MAXIMUM_LINE;
    memcpy(reader->text, cursor->at, kept);
    reader->text[kept] = 0;
    cursor->at = end + 1;
    split(reader);
    return LOBE_OK;
}

static bool word_is(const header_reader *reader, size_t index, const char *word) {
    return index < reader->word_count && strcmp(reader->words[index], word) == 0;
}

// ---------------------------------------------------------------------------------------------
// Statements

static lobe_result read_format(header_reader *reader) {
    reader->header->ascii = word_is(reader, 1, "ascii");
    if (!reader->header->ascii && !word_is(reader, 1, "binary_little_endian"))
        return fail(reader, LOBE_ERROR_UNSUPPORTED,
                    "the format is neither ascii nor binary_little_endian");
    if (!word_is(reader, 2, "1.0"))
        return fail(reader, LOBE_ERROR_UNSUPPORTED, "the format's version is not 1.0");
    reader->formatted = true;
    return LOBE_OK;
}

static lobe_result read_element(header_reader *reader) {
    ply_header *header = reader->header;
    if (header->element_count == PLY_MAXIMUM_ELEMENTS)
        return fail(reader, LOBE_ERROR_LIMIT, "more than 16 elements");
    ply_element *element = &header->elements[header->element_count];
    const char *text = reader->word_count == 3 ? reader->words[2] : "";
    text_cursor number = {text, text + strlen(text)};
    if (!scenes_text_cursor_integer(&number, UINT32_MAX, &element->count))
        return fail(reader, LOBE_ERROR_MALFORMED, "not 'element NAME COUNT'");
    element->vertices = word_is(reader, 1, "vertex");
    element->polygons = word_is(reader, 1, "face");
    header->element_count++;
    return LOBE_OK;
}

static ply_type find_type(const char *word) {
    static const char *const names[PLY_TYPE_COUNT][2] = {
        [PLY_CHAR] = {"char", "int8"},      [PLY_UCHAR] = {"uchar", "uint8"},
        [PLY_SHORT] = {"short", "int16"},   [PLY_USHORT] = {"ushort", "uint16"},
        [PLY_INT] = {"int", "int32"},       [PLY_UINT] = {"uint", "uint32"},
        [PLY_FLOAT] = {"float", "float32"}, [PLY_DOUBLE] = {"double", "float64"}};
    ply_type type = 0;
    while (type < PLY_TYPE_COUNT && strcmp(word, names[type][0]) && strcmp(word, names[type][1]))
        type++;
    return type;
}

static ply_role find_role(const ply_element *element, bool list, const char *name) {
    static const char *const axes[] = {"x", "y", "z"};
    for (ply_role role = PLY_X; element->vertices && !list && role <= PLY_Z; role++)
        if (strcmp(name, axes[role]) == 0)
            return role;
    bool polygon = strcmp(name, "vertex_indices") == 0 || strcmp(name, "vertex_index") == 0;
    return element->polygons && list && polygon ? PLY_POLYGON : PLY_OTHER;
}

static lobe_result read_property(header_reader *reader) {
    ply_header *header = reader->header;
    if (header->element_count == 0)
        return fail(reader, LOBE_ERROR_MALFORMED, "a property outside of an element");
    ply_element *element = &header->elements[header->element_count - 1];
    if (element->property_count == PLY_MAXIMUM_PROPERTIES)
        return fail(reader, LOBE_ERROR_LIMIT, "more than 64 properties");
    bool list = word_is(reader, 1, "list");
    if (reader->word_count != (list ? 5 : 3))
        return fail(reader, LOBE_ERROR_MALFORMED,
                    "neither 'property TYPE NAME' nor 'property list TYPE TYPE NAME'");
    ply_property property = {.list = list};
    property.count_type = list ? find_type(reader->words[2]) : PLY_UCHAR;
    property.type = find_type(reader->words[list ? 3 : 1]);
    property.role = find_role(element, list, reader->words[list ? 4 : 2]);
    if (property.type == PLY_TYPE_COUNT || property.count_type == PLY_TYPE_COUNT)
        return fail(reader, LOBE_ERROR_MALFORMED, "a type unknown to PLY");
    element->properties[element->property_count++] = property;
    return LOBE_OK;
}

static lobe_result read_statement(header_reader *reader) {
    if (reader->word_count == 0 || word_is(reader, 0, "comment") || word_is(reader, 0, "obj_info"))
        return LOBE_OK;
    if (word_is(reader, 0, "format"))
        return read_format(reader);
    if (word_is(reader, 0, "element"))
        return read_element(reader);
    if (word_is(reader, 0, "property"))
        return read_property(reader);
    return fail(reader, LOBE_ERROR_MALFORMED, "neither format, element, property nor comment");
}

// ---------------------------------------------------------------------------------------------
// Checks of the whole header

static unsigned roles_of(const ply_element *element) {
    unsigned roles = 0;
    for (size_t i = 0; i < element->property_count; i++)
        roles |= 1u << element->properties[i].role;
    return roles;
}

static lobe_result check_element(header_reader *reader, ply_element *element) {
    const unsigned position = 1u << PLY_X | 1u << PLY_Y | 1u << PLY_Z;
    unsigned roles = roles_of(element);
    // Every element takes at least a byte.
    size_t left = (size_t)(reader->cursor->end - reader->cursor->at);
    if (element->count > left || (element->count > 0 && element->property_count == 0))
        return fail(reader, LOBE_ERROR_MALFORMED, "claims more elements than the file can hold");
    element->vertices = element->vertices && (roles & position) == position;
    element->polygons = roles & 1u << PLY_POLYGON;
    reader->vertices |= element->vertices;
    reader->polygons |= element->polygons;
    return LOBE_OK;
}

static lobe_result check_header(header_reader *reader) {
    lobe_result status = LOBE_OK;
    for (size_t i = 0; !status && i < reader->header->element_count; i++)
        status = check_element(reader, &reader->header->elements[i]);
    if (status)
        return status;
    if (!reader->formatted)
        return fail(reader, LOBE_ERROR_MALFORMED, "no format is stated");
    if (!reader->vertices)
        return fail(reader, LOBE_ERROR_MALFORMED, "no element 'vertex' with x, y and z");
    if (!reader->polygons)
        return fail(reader, LOBE_ERROR_MALFORMED, "no element 'face' with a list vertex_indices");
    return LOBE_OK;
}

lobe_result ply_header_read(text_cursor *cursor, const char *name, const lobe_host *host,
                            ply_header *header) {
    header_reader reader = {.name = name, .host = host, .cursor = cursor, .header = header};
    *header = (ply_header){0};
    lobe_result status = next_line(&reader);
    if (!status && !(reader.word_count == 1 && word_is(&reader, 0, "ply")))
        status = fail(&reader, LOBE_ERROR_UNSUPPORTED, "not a PLY file");
    if (!status)
        status = next_line(&reader);
    while (!status && !word_is(&reader, 0, "end_header")) {
        status = read_statement(&reader);
        if (!status)
            status = next_line(&reader);
    }
    return status ? status : check_header(&reader);
}
