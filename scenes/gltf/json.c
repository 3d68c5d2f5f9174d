#include "scenes/gltf/json.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define STRING_SIZE 256

typedef struct json_parser {
    const json_text *text;
    const char *at, *end;
    unsigned line, depth;
    char path[256]; // of the current value, truncated if it is too long
    size_t path_length;
    lobe_result result;
} json_parser;

static bool check_value(json_parser *parser, const json_schema *schema);

static const json_schema anything = {.kind = JSON_ANY};

// ---------------------------------------------------------------------------------------------
// Messages

static bool fail(json_parser *parser, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool fail(json_parser *parser, const char *format, ...) {
    char cause[160];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(cause, sizeof cause, format, arguments);
    va_end(arguments);
    bool named = parser->path_length > 0;
    parser->result = lobe_host_fail(parser->text->host, LOBE_ERROR_MALFORMED, "%s: line %u: %s%s%s",
                                    parser->text->name, parser->line, named ? parser->path : "",
                                    named ? ": " : "", cause);
    return false;
}

static size_t push_path(json_parser *parser, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Returns the previous length, to restore later.
static size_t push_path(json_parser *parser, const char *format, ...) {
    size_t before = parser->path_length;
    size_t room = sizeof parser->path - before;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(parser->path + before, room, format, arguments);
    va_end(arguments);
    parser->path_length += length < 0 ? 0 : (size_t)length < room ? (size_t)length : room - 1;
    return before;
}

static void pop_path(json_parser *parser, size_t length) {
    parser->path_length = length;
    parser->path[length] = 0;
}

// ---------------------------------------------------------------------------------------------
// Lexical elements

static void skip_space(json_parser *parser) {
    for (; parser->at < parser->end; parser->at++) {
        char c = *parser->at;
        if (c == '\n')
            parser->line++;
        else if (c != ' ' && c != '\t' && c != '\r')
            break;
    }
}

static char peek(const json_parser *parser) {
    return parser->at < parser->end ? *parser->at : '\0';
}

static bool take(json_parser *parser, char c) {
    if (parser->at >= parser->end || *parser->at != c)
        return false;
    parser->at++;
    return true;
}

static bool expect(json_parser *parser, char c) {
    skip_space(parser);
    if (take(parser, c))
        return true;
    if (parser->at >= parser->end)
        return fail(parser, "the text ends where '%c' is expected", c);
    return fail(parser, "'%c' expected", c);
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static size_t skip_digits(json_parser *parser) {
    const char *begin = parser->at;
    while (is_digit(peek(parser)))
        parser->at++;
    return (size_t)(parser->at - begin);
}

typedef struct json_number {
    bool integer;   // without sign, fraction and exponent
    uint64_t value; // of an integer; UINT64_MAX if it is larger
} json_number;

static uint64_t digits_value(const char *digits, size_t count) {
    uint64_t value = 0;
    for (size_t i = 0; i < count; i++) {
        if (value >= UINT64_MAX / 10 - 1)
            return UINT64_MAX;
        value = 10 * value + (uint64_t)(digits[i] - '0');
    }
    return value;
}

static bool read_number(json_parser *parser, json_number *number) {
    number->integer = !take(parser, '-');
    const char *digits = parser->at;
    size_t count = skip_digits(parser);
    if (count == 0 || (count > 1 && *digits == '0'))
        return fail(parser, "not a JSON number");
    number->value = digits_value(digits, count);
    if (take(parser, '.')) {
        number->integer = false;
        if (skip_digits(parser) == 0)
            return fail(parser, "digits expected after the point");
    }
    if (take(parser, 'e') || take(parser, 'E')) {
        number->integer = false;
        if (!take(parser, '+'))
            take(parser, '-');
        if (skip_digits(parser) == 0)
            return fail(parser, "digits expected in the exponent");
    }
    return true;
}

static bool read_hexadecimal(json_parser *parser, unsigned *code) {
    *code = 0;
    for (int i = 0; i < 4; i++) {
        char c = peek(parser);
        unsigned digit = is_digit(c)            ? (unsigned)(c - '0')
                         : c >= 'a' && c <= 'f' ? (unsigned)(c - 'a' + 10)
                         : c >= 'A' && c <= 'F' ? (unsigned)(c - 'A' + 10)
                                                : 16;
        if (digit == 16)
            return fail(parser, "four hexadecimal digits expected after \\u");
        *code = 16 * *code + digit;
        parser->at++;
    }
    return true;
}

// No name in a schema has characters beyond ASCII: '?' replaces them.
static bool read_escape(json_parser *parser, char *c) {
    static const char escapes[] = "\"\\/bfnrt", meanings[] = "\"\\/\b\f\n\r\t";
    unsigned code;
    if (take(parser, 'u')) {
        if (!read_hexadecimal(parser, &code))
            return false;
        *c = code > 0 && code < 0x80 ? (char)code : '?';
        return true;
    }
    const char *found = peek(parser) ? strchr(escapes, peek(parser)) : NULL;
    if (!found)
        return fail(parser, "unknown escape in a string");
    *c = meanings[found - escapes];
    parser->at++;
    return true;
}

static bool read_string(json_parser *parser, char text[STRING_SIZE]) {
    size_t length = 0;
    if (!expect(parser, '"'))
        return false;
    while (!take(parser, '"')) {
        if (parser->at >= parser->end)
            return fail(parser, "the text ends inside a string");
        char c = *parser->at++;
        if ((unsigned char)c < 0x20)
            return fail(parser, "control character in a string");
        if (c == '\\' && !read_escape(parser, &c))
            return false;
        if (length + 1 < STRING_SIZE)
            text[length++] = c;
    }
    text[length] = 0;
    return true;
}

static bool read_literal(json_parser *parser, const char *literal) {
    size_t length = strlen(literal);
    if ((size_t)(parser->end - parser->at) < length || memcmp(parser->at, literal, length) != 0)
        return fail(parser, "a JSON value expected");
    parser->at += length;
    return true;
}

// ---------------------------------------------------------------------------------------------
// Values

static const json_member *find_member(const json_schema *schema, const char *name) {
    for (const json_member *m = schema->members; m && m->name; m++) {
        if (strcmp(m->name, name) == 0)
            return m;
    }
    return NULL;
}

static bool check_member(json_parser *parser, const json_schema *schema, uint32_t *seen) {
    char name[STRING_SIZE];
    skip_space(parser);
    if (!read_string(parser, name) || !expect(parser, ':'))
        return false;
    const json_member *member = find_member(schema, name);
    const json_schema *other = schema->element ? schema->element : &anything;
    if (member)
        *seen |= UINT32_C(1) << (member - schema->members);
    size_t before = push_path(parser, "%s%.63s", parser->path_length ? "." : "", name);
    bool done = check_value(parser, member ? member->schema : other);
    pop_path(parser, before);
    return done;
}

static bool check_required(json_parser *parser, const json_schema *schema, uint32_t seen) {
    for (const json_member *m = schema->members; m && m->name; m++) {
        if (m->required && !(seen & UINT32_C(1) << (m - schema->members)))
            return fail(parser, "'%s' is missing", m->name);
    }
    return true;
}

static bool check_object(json_parser *parser, const json_schema *schema) {
    uint32_t seen = 0;
    parser->at++;
    const size_t begin = (size_t)(parser->at - parser->text->bytes);
    skip_space(parser);
    if (!take(parser, '}')) {
        do {
            if (!check_member(parser, schema, &seen))
                return false;
            skip_space(parser);
        } while (take(parser, ','));
        if (!expect(parser, '}'))
            return false;
    }
    if (!check_required(parser, schema, seen))
        return false;
    if (schema->leave)
        parser->result = schema->leave(parser->text->user, begin, seen);
    return parser->result == LOBE_OK;
}

static bool check_array(json_parser *parser, const json_schema *schema) {
    size_t count = 0;
    parser->at++;
    skip_space(parser);
    if (!take(parser, ']')) {
        do {
            size_t before = push_path(parser, "[%zu]", count);
            if (!check_value(parser, schema->element ? schema->element : &anything))
                return false;
            pop_path(parser, before);
            count++;
            skip_space(parser);
        } while (take(parser, ','));
        if (!expect(parser, ']'))
            return false;
    }
    if (schema->length > 0 && count != schema->length)
        return fail(parser, "%u elements expected, %zu found", schema->length, count);
    if (schema->filled && count == 0)
        return fail(parser, "an element expected, none found");
    return true;
}

static bool check_string(json_parser *parser, const json_schema *schema) {
    char text[STRING_SIZE];
    if (!read_string(parser, text))
        return false;
    if (schema->visit)
        parser->result = schema->visit(parser->text->user, text);
    return parser->result == LOBE_OK;
}

static bool check_number(json_parser *parser, const json_schema *schema) {
    json_number number = {0};
    if (!read_number(parser, &number))
        return false;
    bool index = schema->kind == JSON_INDEX;
    if (!index && schema->kind != JSON_SIZE)
        return true;
    if (!number.integer)
        return fail(parser, "a non-negative integer expected");
    if (number.value > (index ? (uint64_t)INT32_MAX - 1 : UINT64_C(1) << 53))
        return fail(parser, "the integer is too large");
    return true;
}

static bool is_kind(json_kind kind, char first) {
    switch (kind) {
    case JSON_OBJECT:
        return first == '{';
    case JSON_ARRAY:
        return first == '[';
    case JSON_STRING:
        return first == '"';
    case JSON_BOOLEAN:
        return first == 't' || first == 'f';
    case JSON_NUMBER:
    case JSON_INDEX:
    case JSON_SIZE:
        return first == '-' || is_digit(first);
    default:
        return true;
    }
}

static const char *kind_name(json_kind kind) {
    static const char *const names[] = {
        [JSON_ANY] = "a value",     [JSON_OBJECT] = "an object",      [JSON_ARRAY] = "an array",
        [JSON_STRING] = "a string", [JSON_NUMBER] = "a number",       [JSON_INDEX] = "an integer",
        [JSON_SIZE] = "an integer", [JSON_BOOLEAN] = "true or false",
    };
    return names[kind];
}

static bool check_nested(json_parser *parser, const json_schema *schema, bool object) {
    if (parser->depth >= JSON_MAXIMUM_DEPTH)
        return fail(parser, "nested deeper than %d", JSON_MAXIMUM_DEPTH);
    parser->depth++;
    bool done = object ? check_object(parser, schema) : check_array(parser, schema);
    parser->depth--;
    return done;
}

static bool check_value(json_parser *parser, const json_schema *schema) {
    skip_space(parser);
    if (parser->at >= parser->end)
        return fail(parser, "the text ends where a value is expected");
    char first = peek(parser);
    if (!is_kind(schema->kind, first))
        return fail(parser, "%s expected", kind_name(schema->kind));
    switch (first) {
    case '{':
        return check_nested(parser, schema, true);
    case '[':
        return check_nested(parser, schema, false);
    case '"':
        return check_string(parser, schema);
    case 't':
        return read_literal(parser, "true");
    case 'f':
        return read_literal(parser, "false");
    case 'n':
        return read_literal(parser, "null");
    default:
        if (first == '-' || is_digit(first))
            return check_number(parser, schema);
        return fail(parser, "a JSON value expected");
    }
}

lobe_result scenes_json_check(const json_text *text, const json_schema *schema) {
    json_parser parser = {.text = text, .at = text->bytes, .end = text->bytes + text->size};
    parser.line = 1;
    if (!check_value(&parser, schema))
        return parser.result;
    skip_space(&parser);
    if (parser.at < parser.end)
        fail(&parser, "something follows the value");
    return parser.result;
}
