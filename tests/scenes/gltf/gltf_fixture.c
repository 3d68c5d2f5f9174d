#include "tests/scenes/gltf/gltf_fixture.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int gltf_fixture_setup(void **state) {
    gltf_fixture *fixture = calloc(1, sizeof *fixture);
    if (!fixture)
        return -1;
    snprintf(fixture->folder, sizeof fixture->folder, "/tmp/lobe-gltf-XXXXXX");
    *state = fixture;
    return mkdtemp(fixture->folder) ? 0 : -1;
}

int gltf_fixture_teardown(void **state) {
    gltf_fixture *fixture = *state;
    DIR *folder = opendir(fixture->folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        unlink(gltf_fixture_path(fixture, entry->d_name));
    if (folder)
        closedir(folder);
    int result = rmdir(fixture->folder);
    free(fixture);
    return result;
}

const char *gltf_fixture_path(const gltf_fixture *fixture, const char *name) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", fixture->folder, name);
    return path;
}

void gltf_fixture_write(const gltf_fixture *fixture, const char *name, const void *bytes,
                        size_t size) {
    FILE *file = fopen(gltf_fixture_path(fixture, name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void gltf_fixture_write_text(const gltf_fixture *fixture, const char *name, const char *text) {
    gltf_fixture_write(fixture, name, text, strlen(text));
}

static size_t append_word(uint8_t *file, size_t at, uint32_t word) {
    memcpy(file + at, &word, sizeof word);
    return at + sizeof word;
}

static size_t append_chunk(uint8_t *file, size_t at, uint32_t type, const void *content,
                           size_t size, char padding) {
    size_t padded = (size + 3) / 4 * 4;
    at = append_word(file, at, (uint32_t)padded);
    at = append_word(file, at, type);
    memcpy(file + at, content, size);
    memset(file + at + size, padding, padded - size);
    return at + padded;
}

void gltf_fixture_write_glb(const gltf_fixture *fixture, const char *name, const char *json,
                            const void *binary, size_t size) {
    uint8_t *file = malloc(strlen(json) + size + 64);
    assert_non_null(file);
    memcpy(file, "glTF", 4);
    append_word(file, 4, 2);
    size_t end = append_chunk(file, 12, 0x4e4f534a, json, strlen(json), ' ');
    if (binary)
        end = append_chunk(file, end, 0x004e4942, binary, size, 0);
    append_word(file, 8, (uint32_t)end);
    gltf_fixture_write(fixture, name, file, end);
    free(file);
}

static void on_log(void *user, lobe_log_level level, const char *message) {
    gltf_fixture *fixture = user;
    if (level == LOBE_LOG_ERROR) {
        fixture->errors++;
        snprintf(fixture->error, sizeof fixture->error, "%s", message);
    } else if (level == LOBE_LOG_WARNING) {
        fixture->warnings++;
        size_t length = strlen(fixture->warnings_text);
        snprintf(fixture->warnings_text + length, sizeof fixture->warnings_text - length, "%s\n",
                 message);
    } else if (level == LOBE_LOG_NOTICE) {
        fixture->notices++;
    }
}

lobe_result gltf_fixture_open_path(gltf_fixture *fixture, const char *path, lobe_scene **scene) {
    lobe_host host = {.write = on_log, .user = fixture};
    fixture->errors = fixture->warnings = fixture->notices = 0;
    fixture->error[0] = fixture->warnings_text[0] = 0;
    *scene = (lobe_scene *)fixture; // must be overwritten
    lobe_result result = lobe_scene_open(path, &host, scene);
    if (result == LOBE_OK) {
        assert_non_null(*scene);
        assert_int_equal(fixture->errors, 0);
    } else {
        assert_null(*scene);
        assert_int_equal(fixture->errors, 1);
        assert_non_null(strstr(fixture->error, path));
        assert_null(strchr(fixture->error, '\n'));
    }
    return result;
}

lobe_result gltf_fixture_open(gltf_fixture *fixture, const char *name, lobe_scene **scene) {
    return gltf_fixture_open_path(fixture, gltf_fixture_path(fixture, name), scene);
}

lobe_scene *gltf_fixture_must_open(gltf_fixture *fixture, const char *name) {
    lobe_scene *scene;
    lobe_result result = gltf_fixture_open(fixture, name, &scene);
    if (result != LOBE_OK)
        fail_msg("%s: %s", lobe_result_name(result), fixture->error);
    return scene;
}

void gltf_fixture_must_fail(gltf_fixture *fixture, const char *name, lobe_result expected,
                            const char *cause) {
    lobe_scene *scene;
    lobe_result result = gltf_fixture_open(fixture, name, &scene);
    lobe_scene_destroy(&scene);
    if (result != expected || !strstr(fixture->error, cause))
        fail_msg("%s instead of %s with '%s': %s", lobe_result_name(result),
                 lobe_result_name(expected), cause, fixture->error);
}

// ---------------------------------------------------------------------------------------------
// A file with one primitive

typedef struct mesh_text {
    char views[4096], accessors[4096], attributes[1024], indices[32];
    uint8_t binary[65536];
    size_t size;
} mesh_text;

static void append_text(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void append_text(char *text, size_t size, const char *format, ...) {
    size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    int added = vsnprintf(text + length, size - length, format, arguments);
    va_end(arguments);
    assert_true(added >= 0 && (size_t)added < size - length);
}

static void append_accessor(mesh_text *text, const gltf_fixture_accessor *accessor, size_t index) {
    const char *comma = index > 0 ? "," : "";
    append_text(text->views, sizeof text->views,
                "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", comma, text->size,
                accessor->size);
    append_text(text->accessors, sizeof text->accessors,
                "%s{\"bufferView\":%zu,\"componentType\":%d,\"type\":\"%s\",\"count\":%zu,"
                "\"normalized\":%s}",
                comma, index, accessor->component, accessor->type, accessor->count,
                accessor->normalised ? "true" : "false");
    if (accessor->name)
        append_text(text->attributes, sizeof text->attributes, "%s\"%s\":%zu",
                    *text->attributes ? "," : "", accessor->name, index);
    else
        append_text(text->indices, sizeof text->indices, ",\"indices\":%zu", index);
    assert_true(text->size + accessor->size + 4 <= sizeof text->binary);
    memcpy(text->binary + text->size, accessor->data, accessor->size);
    text->size = (text->size + accessor->size + 3) / 4 * 4;
}

void gltf_fixture_write_mesh(const gltf_fixture *fixture, const char *name,
                             const gltf_fixture_mesh *mesh) {
    mesh_text *text = calloc(1, sizeof *text);
    char *json = calloc(1, 16384);
    assert_non_null(text);
    assert_non_null(json);
    for (size_t i = 0; i < mesh->accessor_count; i++)
        append_accessor(text, &mesh->accessors[i], i);
    append_text(json, 16384,
                "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                "\"nodes\":[{\"mesh\":0%s}],\"meshes\":[{\"name\":\"shape\",\"primitives\":["
                "{\"attributes\":{%s}%s,\"mode\":%d%s}]}],\"buffers\":[{\"byteLength\":%zu}],"
                "\"bufferViews\":[%s],\"accessors\":[%s]%s}",
                mesh->node ? mesh->node : "", text->attributes, text->indices,
                mesh->mode ? mesh->mode : GLTF_TRIANGLES, mesh->primitive ? mesh->primitive : "",
                text->size, text->views, text->accessors, mesh->root ? mesh->root : "");
    gltf_fixture_write_glb(fixture, name, json, text->binary, text->size);
    free(json);
    free(text);
}

static const float triangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
const gltf_fixture_accessor gltf_fixture_triangle = {"POSITION", GLTF_FLOAT, "VEC3",         false,
                                                     3,          triangle,   sizeof triangle};

void gltf_fixture_assert_near(const float *values, const float *expected, size_t count,
                              float tolerance) {
    for (size_t i = 0; i < count; i++) {
        if (!(fabsf(values[i] - expected[i]) <= tolerance))
            fail_msg("value %zu is %.9g, not %.9g", i, (double)values[i], (double)expected[i]);
    }
}
