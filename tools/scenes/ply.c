#include "tools/scenes/mesh_formats.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "tools/scenes/ply_header.h"
#include "tools/scenes/polygon_mesh.h"

typedef struct ply_reader {
    const char *name;
    const lobe_host *host;
    text_cursor cursor; // in the data, text or binary
    ply_header header;
    polygon_mesh polygons;
    const char *kind; // of the current element, with its number below: for messages
    size_t item;
} ply_reader;

static lobe_result fail(const ply_reader *reader, lobe_result result, const char *cause) {
    return lobe_host_fail(reader->host, result, "%s: %s %zu: %s", reader->name, reader->kind,
                          reader->item, cause);
}

// ---------------------------------------------------------------------------------------------
// Values

static double from_bytes(ply_type type, uint64_t bits) {
    float single;
    double number;
    switch (type) {
    case PLY_CHAR:
        return (int8_t)bits;
    case PLY_SHORT:
        return (int16_t)bits;
    case PLY_INT:
        return (int32_t)bits;
    case PLY_FLOAT:
        memcpy(&single, &(uint32_t){(uint32_t)bits}, sizeof single);
        return single;
    case PLY_DOUBLE:
        memcpy(&number, &bits, sizeof number);
        return number;
    default:
        return (double)bits;
    }
}

static lobe_result read_value(ply_reader *reader, ply_type type, double *value) {
    static const size_t sizes[] = {
        [PLY_CHAR] = 1, [PLY_UCHAR] = 1, [PLY_SHORT] = 2, [PLY_USHORT] = 2,
        [PLY_INT] = 4,  [PLY_UINT] = 4,  [PLY_FLOAT] = 4, [PLY_DOUBLE] = 8};
    text_cursor *cursor = &reader->cursor;
    if (reader->header.ascii)
        scenes_text_cursor_skip_space(cursor);
    size_t left = (size_t)(cursor->end - cursor->at);
    if (left < (reader->header.ascii ? 1 : sizes[type]))
        return fail(reader, LOBE_ERROR_MALFORMED, "the file ends early");
    if (reader->header.ascii)
        return scenes_text_cursor_number(cursor, value)
                   ? LOBE_OK
                   : fail(reader, LOBE_ERROR_MALFORMED, "not a number in the range of float");
    uint64_t bits = 0;
    for (size_t i = 0; i < sizes[type]; i++)
        bits |= (uint64_t)(uint8_t)*cursor->at++ << 8 * i;
    *value = from_bytes(type, bits);
    return LOBE_OK;
}

// A whole number, for counts and indices.
static lobe_result read_index(ply_reader *reader, ply_type type, uint32_t *index) {
    double value;
    lobe_result status = read_value(reader, type, &value);
    if (status)
        return status;
    if (!(value >= 0 && value <= UINT32_MAX) || value != floor(value))
        return fail(reader, LOBE_ERROR_MALFORMED, "an index or count is not a whole number from 0");
    *index = (uint32_t)value;
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Elements

// A fan around the first corner; polygons with fewer than three corners have no area.
static lobe_result read_polygon(ply_reader *reader, ply_type type, uint32_t count) {
    uint32_t first = 0, previous = 0, corner = 0;
    for (uint32_t i = 0; i < count; i++) {
        lobe_result status = read_index(reader, type, &corner);
        if (status)
            return status;
        if (i == 0)
            first = corner;
        if (i >= 2 && !polygon_mesh_add_triangle(&reader->polygons, first, previous, corner))
            return fail(reader, LOBE_ERROR_OUT_OF_MEMORY, "out of memory");
        previous = corner;
    }
    return LOBE_OK;
}

static lobe_result read_list(ply_reader *reader, const ply_property *property) {
    uint32_t count = 0;
    double passed_over;
    lobe_result status = read_index(reader, property->count_type, &count);
    if (!status && property->role == PLY_POLYGON)
        return read_polygon(reader, property->type, count);
    for (uint32_t i = 0; !status && i < count; i++)
        status = read_value(reader, property->type, &passed_over);
    return status;
}

static lobe_result read_item(ply_reader *reader, const ply_element *element) {
    double position[PLY_OTHER + 1] = {0};
    lobe_result status = LOBE_OK;
    for (size_t i = 0; !status && i < element->property_count; i++) {
        const ply_property *property = &element->properties[i];
        status = property->list ? read_list(reader, property)
                                : read_value(reader, property->type, &position[property->role]);
    }
    if (status || !element->vertices)
        return status;
    for (int axis = 0; axis < 3; axis++)
        if (!(fabs(position[axis]) <= (double)FLT_MAX))
            return fail(reader, LOBE_ERROR_MALFORMED, "its position is not finite");
    if (!polygon_mesh_add_position(&reader->polygons, position))
        return fail(reader, LOBE_ERROR_OUT_OF_MEMORY, "out of memory");
    return LOBE_OK;
}

static lobe_result read_data(ply_reader *reader) {
    lobe_result status = LOBE_OK;
    for (size_t i = 0; !status && i < reader->header.element_count; i++) {
        const ply_element *element = &reader->header.elements[i];
        reader->kind = element->vertices ? "vertex" : element->polygons ? "face" : "element";
        for (size_t k = 0; !status && k < element->count; k++) {
            reader->item = k;
            status = read_item(reader, element);
        }
    }
    return status;
}

lobe_result ply_read(const void *bytes, size_t size, const char *name, const lobe_host *host,
                     lobe_mesh *mesh) {
    const char *begin = bytes;
    ply_reader reader = {.name = name,
                         .host = host,
                         .polygons.allocator = lobe_host_allocator(host),
                         .cursor = {begin, begin + size}};
    *mesh = (lobe_mesh){0};
    lobe_result status = ply_header_read(&reader.cursor, name, host, &reader.header);
    if (!status)
        status = read_data(&reader);
    if (!status)
        status = polygon_mesh_finish(&reader.polygons, name, host, mesh);
    polygon_mesh_free(&reader.polygons);
    return status;
}
