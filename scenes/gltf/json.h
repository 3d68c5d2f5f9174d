#ifndef SCENES_GLTF_JSON_H
#define SCENES_GLTF_JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// Checks JSON text (RFC 8259) against the types that a reader expects, before the reader sees it.
/// Builds no document: memory use does not depend on the text.

typedef enum json_kind {
    JSON_ANY,
    JSON_OBJECT,
    JSON_ARRAY,
    JSON_STRING,
    JSON_NUMBER,
    JSON_INDEX, ///< an integer [0, 2^31 - 2] without fraction or exponent
    JSON_SIZE,  ///< an integer [0, 2^53] without fraction or exponent
    JSON_BOOLEAN,
} json_kind;

typedef struct json_schema json_schema;

typedef struct json_member {
    const char *name; ///< at most 63 bytes
    const json_schema *schema;
    bool required;
} json_member;

struct json_schema {
    json_kind kind;
    const json_member *members; ///< of an object, at most 32; the last has a NULL name
    const json_schema *element; ///< of an array; of an object: unlisted members. NULL: any
    unsigned length;            ///< of an array; 0: any
    bool filled;                ///< the array must not be empty
    /// Unless NULL, called with each string (truncated to 255 bytes). An error, which it must have
    /// logged, ends the check.
    lobe_result (*visit)(void *user, const char *text);
    /// Unless NULL, called after each object, with the place of its first member in the text, and a
    /// bit for each listed member that it has. Errors as above.
    lobe_result (*leave)(void *user, size_t begin, uint32_t members);
};

typedef struct json_text {
    const char *name; ///< of the file, for messages
    const char *bytes;
    size_t size;
    const lobe_host *host;
    void *user; ///< for json_schema.visit and .leave
} json_text;

/// Deepest nesting accepted.
#define JSON_MAXIMUM_DEPTH 128

/// LOBE_ERROR_MALFORMED, with a message that says where and what, or the error that a visit
/// returned.
lobe_result scenes_json_check(const json_text *text, const json_schema *schema);

#endif
