#ifndef TOOLS_SCENES_PLY_HEADER_H
#define TOOLS_SCENES_PLY_HEADER_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "scenes/format/text_cursor.h"

/// The description of the data in the header of a PLY file.

enum { PLY_MAXIMUM_ELEMENTS = 16, PLY_MAXIMUM_PROPERTIES = 64 };

typedef enum ply_type {
    PLY_CHAR,
    PLY_UCHAR,
    PLY_SHORT,
    PLY_USHORT,
    PLY_INT,
    PLY_UINT,
    PLY_FLOAT,
    PLY_DOUBLE,
    PLY_TYPE_COUNT ///< none of these
} ply_type;

/// The meaning of a property to lobe.
typedef enum ply_role { PLY_X, PLY_Y, PLY_Z, PLY_POLYGON, PLY_OTHER } ply_role;

typedef struct ply_property {
    ply_role role;
    bool list;
    ply_type count_type; ///< of a list's length
    ply_type type;       ///< of a value, or of each value of a list
} ply_property;

typedef struct ply_element {
    bool vertices; ///< it has PLY_X, PLY_Y and PLY_Z
    bool polygons; ///< it has PLY_POLYGON
    size_t count;
    ply_property properties[PLY_MAXIMUM_PROPERTIES];
    size_t property_count;
} ply_element;

typedef struct ply_header {
    bool ascii; ///< else binary, little endian
    ply_element elements[PLY_MAXIMUM_ELEMENTS];
    size_t element_count;
} ply_header;

/// Reads the header and moves past it. `name` is for messages. Errors: as for ply_read. On success,
/// no element has more items than the bytes after the header can hold, and there is an element with
/// vertices and one with polygons.
lobe_result ply_header_read(text_cursor *cursor, const char *name, const lobe_host *host,
                            ply_header *header);

#endif
