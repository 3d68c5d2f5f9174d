#include "tools/sweep/results.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>
#include <lobe/file.h>

#include "tools/cli/output_file.h"

// ---------------------------------------------------------------------------------------------
// Members: reading, writing and freeing all follow these tables, so they cannot disagree.

typedef enum member_kind {
    MEMBER_NUMBER,          ///< double; null is NAN
    MEMBER_OPTIONAL_NUMBER, ///< the same; NAN if it is missing
    MEMBER_COUNT,           ///< uint32_t
    MEMBER_LONG_COUNT,      ///< uint64_t
    MEMBER_FLAG,            ///< bool
    MEMBER_OPTIONAL_FLAG,   ///< the same; false if it is missing
    MEMBER_TEXT,            ///< char *, allocated
    MEMBER_OPTIONAL_TEXT,   ///< the same; NULL if it is null or missing
    MEMBER_FIXED_TEXT,      ///< char[size]
    MEMBER_EXTENT,          ///< uint32_t[2]
    MEMBER_STRUCTURE,       ///< a nested structure
    MEMBER_LIST,            ///< a pointer to structures, their number at count_offset
    MEMBER_OPTIONAL_LIST,   ///< the same; empty if it is missing
} member_kind;

typedef struct structure structure;

typedef struct member {
    const char *name;
    member_kind kind;
    size_t offset;
    size_t size;              ///< of a fixed text
    size_t count_offset;      ///< of a list
    const structure *element; ///< of a list; a structure itself
} member;

struct structure {
    size_t size;
    const member *members;
    size_t member_count;
};

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))
#define MEMBER(type, name, kind)                                                                   \
    { #name, kind, offsetof(type, name), 0, 0, NULL }
#define FIXED_TEXT(type, name)                                                                     \
    { #name, MEMBER_FIXED_TEXT, offsetof(type, name), sizeof(((type *)0)->name), 0, NULL }
#define NESTED(type, name, element)                                                                \
    { #name, MEMBER_STRUCTURE, offsetof(type, name), 0, 0, element }
#define LIST(type, name, count, element)                                                           \
    { #name, MEMBER_LIST, offsetof(type, name), 0, offsetof(type, count), element }
#define OPTIONAL_LIST(type, name, count, element)                                                  \
    { #name, MEMBER_OPTIONAL_LIST, offsetof(type, name), 0, offsetof(type, count), element }
#define STRUCTURE(type, members)                                                                   \
    { sizeof(type), members, COUNT_OF(members) }

static const member setting_members[] = {
    FIXED_TEXT(sweep_setting, name),
    FIXED_TEXT(sweep_setting, value),
};
static const structure setting_structure = STRUCTURE(sweep_setting, setting_members);

static const member pass_members[] = {
    FIXED_TEXT(sweep_pass, name),
    MEMBER(sweep_pass, milliseconds, MEMBER_NUMBER),
    MEMBER(sweep_pass, count, MEMBER_COUNT),
    MEMBER(sweep_pass, building, MEMBER_FLAG),
    MEMBER(sweep_pass, once, MEMBER_OPTIONAL_FLAG),
    MEMBER(sweep_pass, bytes, MEMBER_NUMBER),
    MEMBER(sweep_pass, copy_milliseconds, MEMBER_NUMBER),
};
static const structure pass_structure = STRUCTURE(sweep_pass, pass_members);

static const member errors_members[] = {
    MEMBER(error_metrics, rmse, MEMBER_NUMBER),
    MEMBER(error_metrics, relative_mse, MEMBER_NUMBER),
    MEMBER(error_metrics, relative_l2, MEMBER_NUMBER),
    MEMBER(error_metrics, relative_l1, MEMBER_NUMBER),
    MEMBER(error_metrics, psnr, MEMBER_NUMBER),
    MEMBER(error_metrics, mean_ratio, MEMBER_OPTIONAL_NUMBER),
    MEMBER(error_metrics, flip, MEMBER_NUMBER),
};
static const structure errors_structure = STRUCTURE(error_metrics, errors_members);

static const member row_members[] = {
    MEMBER(sweep_row, scene, MEMBER_TEXT),
    MEMBER(sweep_row, filter, MEMBER_TEXT),
    LIST(sweep_row, settings, setting_count, &setting_structure),
    FIXED_TEXT(sweep_row, varied),
    MEMBER(sweep_row, rebuilt_ms, MEMBER_NUMBER),
    MEMBER(sweep_row, rebuilt_p95_ms, MEMBER_NUMBER),
    MEMBER(sweep_row, retained_ms, MEMBER_NUMBER),
    MEMBER(sweep_row, retained_p95_ms, MEMBER_NUMBER),
    MEMBER(sweep_row, building_ms, MEMBER_NUMBER),
    MEMBER(sweep_row, shading_ms, MEMBER_NUMBER),
    MEMBER(sweep_row, changed_ms, MEMBER_OPTIONAL_NUMBER),
    MEMBER(sweep_row, changed_wall_ms, MEMBER_OPTIONAL_NUMBER),
    MEMBER(sweep_row, changed_caller_cpu_ms, MEMBER_OPTIONAL_NUMBER),
    MEMBER(sweep_row, changed_process_cpu_ms, MEMBER_OPTIONAL_NUMBER),
    MEMBER(sweep_row, environment_ms, MEMBER_OPTIONAL_NUMBER),
    LIST(sweep_row, passes, pass_count, &pass_structure),
    MEMBER(sweep_row, memory_bytes, MEMBER_LONG_COUNT),
    MEMBER(sweep_row, bytes_per_texel, MEMBER_NUMBER),
    NESTED(sweep_row, error, &errors_structure),
    NESTED(sweep_row, error_lobe_base, &errors_structure),
    MEMBER(sweep_row, inside_relative_l2, MEMBER_OPTIONAL_NUMBER),
    MEMBER(sweep_row, silhouettes_relative_l2, MEMBER_OPTIONAL_NUMBER),
    MEMBER(sweep_row, flicker, MEMBER_NUMBER),
    MEMBER(sweep_row, picture, MEMBER_OPTIONAL_TEXT),
};
static const structure row_structure = STRUCTURE(sweep_row, row_members);

static const member supersampling_members[] = {
    MEMBER(sweep_supersampling, samples, MEMBER_COUNT),
    MEMBER(sweep_supersampling, relative_l2, MEMBER_NUMBER),
};
static const structure supersampling_structure =
    STRUCTURE(sweep_supersampling, supersampling_members);

static const member scene_members[] = {
    MEMBER(sweep_scene, name, MEMBER_TEXT),
    MEMBER(sweep_scene, scene, MEMBER_OPTIONAL_TEXT),
    MEMBER(sweep_scene, environment, MEMBER_OPTIONAL_TEXT),
    MEMBER(sweep_scene, lighting, MEMBER_OPTIONAL_TEXT),
    MEMBER(sweep_scene, triangles, MEMBER_LONG_COUNT),
    MEMBER(sweep_scene, noise, MEMBER_OPTIONAL_NUMBER),
    OPTIONAL_LIST(sweep_scene, supersampling, supersampling_count, &supersampling_structure),
    MEMBER(sweep_scene, reference, MEMBER_OPTIONAL_TEXT),
    MEMBER(sweep_scene, skipped, MEMBER_OPTIONAL_TEXT),
};
static const structure scene_structure = STRUCTURE(sweep_scene, scene_members);

static const member results_members[] = {
    MEMBER(sweep_results, version, MEMBER_TEXT),
    MEMBER(sweep_results, device, MEMBER_TEXT),
    MEMBER(sweep_results, driver, MEMBER_TEXT),
    MEMBER(sweep_results, device_type, MEMBER_TEXT),
    MEMBER(sweep_results, size, MEMBER_EXTENT),
    MEMBER(sweep_results, reference_samples, MEMBER_COUNT),
    MEMBER(sweep_results, path_samples, MEMBER_COUNT),
    MEMBER(sweep_results, stations, MEMBER_COUNT),
    MEMBER(sweep_results, frames, MEMBER_COUNT),
    MEMBER(sweep_results, complete, MEMBER_FLAG),
    LIST(sweep_results, scenes, scene_count, &scene_structure),
    LIST(sweep_results, rows, row_count, &row_structure),
};
static const structure results_structure = STRUCTURE(sweep_results, results_members);

// ---------------------------------------------------------------------------------------------
// Freeing

static void free_members(const structure *structure, void *object) {
    for (size_t i = 0; i < structure->member_count; i++) {
        const member *member = &structure->members[i];
        char *field = (char *)object + member->offset;
        if (member->kind == MEMBER_TEXT || member->kind == MEMBER_OPTIONAL_TEXT)
            free(*(char **)field);
        if (member->kind != MEMBER_LIST && member->kind != MEMBER_OPTIONAL_LIST)
            continue;
        char *elements = *(char **)field;
        size_t count = *(size_t *)((char *)object + member->count_offset);
        for (size_t k = 0; k < count; k++)
            free_members(member->element, elements + k * member->element->size);
        free(elements);
    }
    memset(object, 0, structure->size);
}

void sweep_results_free(sweep_results *results) {
    free_members(&results_structure, results);
}

void sweep_row_free(sweep_row *row) {
    free_members(&row_structure, row);
}

void sweep_scene_free(sweep_scene *scene) {
    free_members(&scene_structure, scene);
}

// ---------------------------------------------------------------------------------------------
// Writing

static cJSON *describe_structure(const structure *structure, const void *object);

/// Six digits exceed the precision of any measurement here. cJSON writes null if it is not finite.
static cJSON *describe_number(double value) {
    if (!isfinite(value) || value == floor(value))
        return cJSON_CreateNumber(value);
    char digits[32];
    snprintf(digits, sizeof digits, "%.6g", value);
    return cJSON_CreateNumber(strtod(digits, NULL));
}

static cJSON *describe_list(const structure *element, const char *elements, size_t count) {
    cJSON *list = cJSON_CreateArray();
    for (size_t i = 0; list && i < count; i++) {
        cJSON *item = describe_structure(element, elements + i * element->size);
        if (item && cJSON_AddItemToArray(list, item))
            continue;
        cJSON_Delete(item);
        cJSON_Delete(list);
        list = NULL;
    }
    return list;
}

static cJSON *describe_member(const member *member, const void *object) {
    const char *field = (const char *)object + member->offset;
    switch (member->kind) {
    case MEMBER_NUMBER:
    case MEMBER_OPTIONAL_NUMBER:
        return describe_number(*(const double *)field);
    case MEMBER_COUNT:
        return cJSON_CreateNumber(*(const uint32_t *)field);
    case MEMBER_LONG_COUNT:
        return cJSON_CreateNumber((double)*(const uint64_t *)field);
    case MEMBER_FLAG:
    case MEMBER_OPTIONAL_FLAG:
        return cJSON_CreateBool(*(const bool *)field);
    case MEMBER_FIXED_TEXT:
        return cJSON_CreateString(field);
    case MEMBER_TEXT:
    case MEMBER_OPTIONAL_TEXT:
        return *(char *const *)field ? cJSON_CreateString(*(char *const *)field)
                                     : cJSON_CreateNull();
    case MEMBER_EXTENT:
        return cJSON_CreateIntArray((const int *)field, 2);
    case MEMBER_STRUCTURE:
        return describe_structure(member->element, field);
    default:
        return describe_list(member->element, *(char *const *)field,
                             *(const size_t *)((const char *)object + member->count_offset));
    }
}

/// NULL if memory runs out.
static cJSON *describe_structure(const structure *structure, const void *object) {
    cJSON *described = cJSON_CreateObject();
    for (size_t i = 0; described && i < structure->member_count; i++) {
        const member *member = &structure->members[i];
        cJSON *item = describe_member(member, object);
        if (item && cJSON_AddItemToObject(described, member->name, item))
            continue;
        cJSON_Delete(item);
        cJSON_Delete(described);
        described = NULL;
    }
    return described;
}

lobe_result sweep_results_write(const char *path, const sweep_results *results,
                                const lobe_host *host) {
    cJSON *root = describe_structure(&results_structure, results);
    char *text = root ? cJSON_Print(root) : NULL;
    cJSON_Delete(root);
    if (!text)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", path);
    lobe_result result = output_file_write(path, text, host);
    free(text);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Reading

/// The reader's position in the file, for messages: "rows[3].passes[0]".
typedef struct reader {
    const char *path;
    const lobe_host *host;
    char place[256];
} reader;

static lobe_result read_structure(reader *reader, const structure *structure, const cJSON *item,
                                  void *object);

static lobe_result malformed(const reader *reader, const char *what) {
    return lobe_host_fail(reader->host, LOBE_ERROR_MALFORMED, "%s: %s: %s", reader->path,
                          reader->place[0] ? reader->place : "the whole file", what);
}

/// Appends to the position; pass the result to leave().
__attribute__((format(printf, 2, 3))) static size_t enter(reader *reader, const char *format, ...) {
    size_t length = strlen(reader->place);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reader->place + length, sizeof reader->place - length, format, arguments);
    va_end(arguments);
    return length;
}

static void leave(reader *reader, size_t length) {
    reader->place[length] = '\0';
}

static bool is_count(const cJSON *item, double maximum) {
    return cJSON_IsNumber(item) && item->valuedouble >= 0 && item->valuedouble <= maximum &&
           item->valuedouble == floor(item->valuedouble);
}

static lobe_result read_number(const reader *reader, const cJSON *item, double *value) {
    *value = cJSON_IsNull(item) ? (double)NAN : item->valuedouble;
    return cJSON_IsNull(item) || cJSON_IsNumber(item)
               ? LOBE_OK
               : malformed(reader, "neither a number nor null");
}

static lobe_result read_count(const reader *reader, const cJSON *item, uint32_t *value) {
    if (!is_count(item, UINT32_MAX))
        return malformed(reader, "not a whole number from 0 to 2^32 - 1");
    *value = (uint32_t)item->valuedouble;
    return LOBE_OK;
}

static lobe_result read_long_count(const reader *reader, const cJSON *item, uint64_t *value) {
    if (!is_count(item, 9007199254740992.0))
        return malformed(reader, "not a whole number from 0 to 2^53");
    *value = (uint64_t)item->valuedouble;
    return LOBE_OK;
}

static lobe_result read_text(const reader *reader, const cJSON *item, char **text) {
    if (!cJSON_IsString(item))
        return malformed(reader, "not a text");
    *text = strdup(item->valuestring);
    return *text ? LOBE_OK
                 : lobe_host_fail(reader->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                                  reader->path);
}

static lobe_result read_fixed_text(const reader *reader, const cJSON *item, char *text,
                                   size_t size) {
    if (!cJSON_IsString(item))
        return malformed(reader, "not a text");
    if (strlen(item->valuestring) >= size)
        return malformed(reader, "text too long");
    strcpy(text, item->valuestring);
    return LOBE_OK;
}

static lobe_result read_extent(const reader *reader, const cJSON *item, uint32_t extent[2]) {
    if (!cJSON_IsArray(item) || cJSON_GetArraySize(item) != 2)
        return malformed(reader, "not a list of two whole numbers");
    lobe_result result = read_count(reader, cJSON_GetArrayItem(item, 0), &extent[0]);
    return result == LOBE_OK ? read_count(reader, cJSON_GetArrayItem(item, 1), &extent[1]) : result;
}

static lobe_result read_list(reader *reader, const structure *element, const cJSON *item,
                             char **elements, size_t *count) {
    if (!cJSON_IsArray(item))
        return malformed(reader, "not a list");
    *elements = calloc((size_t)cJSON_GetArraySize(item) + 1, element->size);
    if (!*elements)
        return lobe_host_fail(reader->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              reader->path);
    const cJSON *child;
    cJSON_ArrayForEach(child, item) {
        size_t length = enter(reader, "[%zu]", *count);
        // Counted before it is read, so that everything is freed after a failure.
        lobe_result result =
            read_structure(reader, element, child, *elements + (*count)++ * element->size);
        leave(reader, length);
        if (result != LOBE_OK)
            return result;
    }
    return LOBE_OK;
}

static lobe_result read_member(reader *reader, const member *member, const cJSON *item,
                               void *object) {
    char *field = (char *)object + member->offset;
    if (member->kind == MEMBER_OPTIONAL_TEXT && (!item || cJSON_IsNull(item)))
        return LOBE_OK;
    if ((member->kind == MEMBER_OPTIONAL_FLAG || member->kind == MEMBER_OPTIONAL_LIST) && !item)
        return LOBE_OK;
    if (member->kind == MEMBER_OPTIONAL_NUMBER && !item) {
        *(double *)field = (double)NAN;
        return LOBE_OK;
    }
    if (!item)
        return malformed(reader, "missing");
    switch (member->kind) {
    case MEMBER_NUMBER:
    case MEMBER_OPTIONAL_NUMBER:
        return read_number(reader, item, (double *)field);
    case MEMBER_COUNT:
        return read_count(reader, item, (uint32_t *)field);
    case MEMBER_LONG_COUNT:
        return read_long_count(reader, item, (uint64_t *)field);
    case MEMBER_FLAG:
    case MEMBER_OPTIONAL_FLAG:
        *(bool *)field = cJSON_IsTrue(item);
        return cJSON_IsBool(item) ? LOBE_OK : malformed(reader, "neither true nor false");
    case MEMBER_FIXED_TEXT:
        return read_fixed_text(reader, item, field, member->size);
    case MEMBER_TEXT:
    case MEMBER_OPTIONAL_TEXT:
        return read_text(reader, item, (char **)field);
    case MEMBER_EXTENT:
        return read_extent(reader, item, (uint32_t *)field);
    case MEMBER_STRUCTURE:
        return read_structure(reader, member->element, item, field);
    default:
        return read_list(reader, member->element, item, (char **)field,
                         (size_t *)((char *)object + member->count_offset));
    }
}

static lobe_result read_structure(reader *reader, const structure *structure, const cJSON *item,
                                  void *object) {
    if (!cJSON_IsObject(item))
        return malformed(reader, "not an object");
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < structure->member_count; i++) {
        const member *member = &structure->members[i];
        size_t length = enter(reader, "%s%s", reader->place[0] ? "." : "", member->name);
        result = read_member(reader, member, cJSON_GetObjectItemCaseSensitive(item, member->name),
                             object);
        leave(reader, length);
    }
    return result;
}

lobe_result sweep_results_read(const char *path, const lobe_host *host, sweep_results *results) {
    *results = (sweep_results){0};
    uint8_t *text;
    size_t size;
    lobe_result result = lobe_file_read(path, NULL, host, &text, &size);
    if (result != LOBE_OK)
        return result;
    const char *end = NULL;
    cJSON *root = cJSON_ParseWithLengthOpts((const char *)text, size + 1, &end, true);
    reader reader = {.path = path, .host = host};
    if (root)
        result = read_structure(&reader, &results_structure, root, results);
    else
        result = lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: not JSON, or cut off, at byte %zu",
                                path, end ? (size_t)(end - (const char *)text) : size);
    cJSON_Delete(root);
    lobe_release(text);
    if (result != LOBE_OK)
        sweep_results_free(results);
    return result;
}
