#include "tools/scenes/mesh_formats.h"

#include <stdbool.h>
#include <string.h>

#include "scenes/format/text_cursor.h"
#include "tools/scenes/polygon_mesh.h"

typedef struct javascript_mesh {
    const char *name;
    const lobe_host *host;
    text_cursor text; // the whole file
    polygon_mesh polygons;
} javascript_mesh;

/// Reads three numbers and adds them. LOBE_ERROR_MALFORMED, not logged, if there are none.
typedef lobe_result add_triple(javascript_mesh *reader, text_cursor *cursor);

static bool is_part_of_name(char c) {
    return c == '_' || c == '$' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
           (c >= 'A' && c <= 'Z');
}

// Whether an array follows: `= [`, `: [`, or the same after the closing quotation mark of a name.
static bool take_array_start(text_cursor *cursor) {
    if (!scenes_text_cursor_take(cursor, '"'))
        scenes_text_cursor_take(cursor, '\'');
    return (scenes_text_cursor_take(cursor, '=') || scenes_text_cursor_take(cursor, ':')) &&
           scenes_text_cursor_take(cursor, '[');
}

// Moves into the array named `member`.
static bool find_array(const javascript_mesh *reader, const char *member, text_cursor *cursor) {
    size_t length = strlen(member);
    const char *begin = reader->text.at, *end = reader->text.end;
    for (const char *at = begin; (size_t)(end - at) > length; at++) {
        at = memmem(at, (size_t)(end - at), member, length);
        if (!at)
            return false;
        *cursor = (text_cursor){at + length, end};
        bool whole = (at == begin || !is_part_of_name(at[-1]));
        if (whole && take_array_start(cursor))
            return true;
    }
    return false;
}

static lobe_result add_position(javascript_mesh *reader, text_cursor *cursor) {
    double position[3];
    for (int axis = 0; axis < 3; axis++)
        if ((axis > 0 && !scenes_text_cursor_take(cursor, ',')) ||
            !scenes_text_cursor_number(cursor, &position[axis]))
            return LOBE_ERROR_MALFORMED;
    return polygon_mesh_add_position(&reader->polygons, position) ? LOBE_OK
                                                                  : LOBE_ERROR_OUT_OF_MEMORY;
}

static lobe_result add_cell(javascript_mesh *reader, text_cursor *cursor) {
    size_t corner[3];
    for (int k = 0; k < 3; k++)
        if ((k > 0 && !scenes_text_cursor_take(cursor, ',')) ||
            !scenes_text_cursor_integer(cursor, UINT32_MAX, &corner[k]))
            return LOBE_ERROR_MALFORMED;
    return polygon_mesh_add_triangle(&reader->polygons, (uint32_t)corner[0], (uint32_t)corner[1],
                                     (uint32_t)corner[2])
               ? LOBE_OK
               : LOBE_ERROR_OUT_OF_MEMORY;
}

// Reads [..., ..., ...] and a comma or the end of the array.
static lobe_result read_triple(javascript_mesh *reader, text_cursor *cursor, add_triple *add,
                               bool *ended) {
    if (!scenes_text_cursor_take(cursor, '['))
        return LOBE_ERROR_MALFORMED;
    lobe_result status = add(reader, cursor);
    if (status)
        return status;
    scenes_text_cursor_take(cursor, ',');
    if (!scenes_text_cursor_take(cursor, ']'))
        return LOBE_ERROR_MALFORMED;
    bool more = scenes_text_cursor_take(cursor, ',');
    *ended = scenes_text_cursor_take(cursor, ']');
    return more || *ended ? LOBE_OK : LOBE_ERROR_MALFORMED;
}

static lobe_result read_array(javascript_mesh *reader, const char *member, add_triple *add) {
    text_cursor cursor;
    if (!find_array(reader, member, &cursor))
        return lobe_host_fail(reader->host, LOBE_ERROR_MALFORMED, "%s: no array '%s'", reader->name,
                              member);
    lobe_result status = LOBE_OK;
    bool ended = scenes_text_cursor_take(&cursor, ']');
    size_t count = 0;
    for (; !status && !ended; count++)
        status = read_triple(reader, &cursor, add, &ended);
    if (status == LOBE_ERROR_OUT_OF_MEMORY)
        return lobe_host_fail(reader->host, status, "%s: out of memory", reader->name);
    if (status)
        return lobe_host_fail(
            reader->host, status,
            cursor.at == cursor.end ? "%s: ends within '%s', element %zu, line %zu"
                                    : "%s: '%s': element %zu, line %zu: not three "
                                      "numbers in brackets",
            reader->name, member, count - 1, scenes_text_cursor_line(&cursor, reader->text.at));
    return LOBE_OK;
}

lobe_result javascript_mesh_read(const char *text, size_t size, const char *name,
                                 const lobe_host *host, lobe_mesh *mesh) {
    javascript_mesh reader = {.name = name,
                              .host = host,
                              .polygons.allocator = lobe_host_allocator(host),
                              .text = {text, text + size}};
    *mesh = (lobe_mesh){0};
    lobe_result status = read_array(&reader, "positions", add_position);
    if (!status)
        status = read_array(&reader, "cells", add_cell);
    if (!status)
        status = polygon_mesh_finish(&reader.polygons, name, host, mesh);
    polygon_mesh_free(&reader.polygons);
    return status;
}
