// Broken glTF files: each fails with the right code and one message that names file and cause.

#include "tests/scenes/gltf/gltf_fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// ---------------------------------------------------------------------------------------------
// Files

static void files_that_are_not_there_or_cannot_be_read(void **state) {
    gltf_fixture *fixture = *state;
    gltf_fixture_must_fail(fixture, "absent.gltf", LOBE_ERROR_NOT_FOUND,
                           "neither a built-in scene nor a file");
    gltf_fixture_must_fail(fixture, "absent/below.gltf", LOBE_ERROR_NOT_FOUND,
                           "neither a built-in scene nor a file");
    gltf_fixture_must_fail(fixture, ".", LOBE_ERROR_NOT_FOUND, "no PNG, JPEG or OpenEXR file");
    assert_int_equal(mkfifo(gltf_fixture_path(fixture, "pipe.glb"), 0600), 0);
    gltf_fixture_must_fail(fixture, "pipe.glb", LOBE_ERROR_READ, "not a regular file");
    // A sparse file is huge without taking up space.
    gltf_fixture_write_text(fixture, "huge.glb", "glTF");
    assert_int_equal(truncate(gltf_fixture_path(fixture, "huge.glb"), 3l << 30), 0);
    gltf_fixture_must_fail(fixture, "huge.glb", LOBE_ERROR_LIMIT, "larger than 2 GiB");
}

static void content_that_is_no_gltf(void **state) {
    static const struct {
        const char *text, *cause;
        lobe_result result;
    } cases[] = {
        {"", "is empty", LOBE_ERROR_MALFORMED},
        {" \n ", "is empty", LOBE_ERROR_MALFORMED},
        {"# Blender v2.8 OBJ", "neither GLB nor JSON", LOBE_ERROR_MALFORMED},
        {"{", "the text ends", LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":\"2.0\"}", "the text ends", LOBE_ERROR_MALFORMED},
        {"{}", "'asset' is missing", LOBE_ERROR_MALFORMED},
        {"{\"asset\":{}}", "'version' is missing", LOBE_ERROR_MALFORMED},
        {"{\"asset\":[]}", "asset: an object expected", LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":2.0}}", "a string expected", LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":\"1.0\"}}", "version 1.0", LOBE_ERROR_UNSUPPORTED},
        {"{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.1\"}}", "needs version 2.1",
         LOBE_ERROR_UNSUPPORTED},
        {"{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco\"]}",
         "requires the unsupported extension KHR_draco", LOBE_ERROR_UNSUPPORTED},
        {"{\"asset\":{\"version\":\"2.0\"},\"nodes\":{}}", "nodes: an array expected",
         LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":\"2.0\"},\"nodes\":[1]}", "nodes[0]: an object expected",
         LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":\"0\"}]}",
         "nodes[0].mesh: an integer expected", LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"scale\":[1e999,1,1]}]}", "1e999",
         LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":\"2.0\",\"generator\":\"\xff\xfe\"}}", "UTF-8",
         LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":\"2.0\"},\"skins\":[{}]}", "'joints' is missing",
         LOBE_ERROR_MALFORMED},
        {"{\"asset\":{\"version\":\"2.0\"},\"images\":[{}]}", "image[0]", LOBE_ERROR_MALFORMED},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        gltf_fixture_write_text(*state, "content.gltf", cases[i].text);
        gltf_fixture_must_fail(*state, "content.gltf", cases[i].result, cases[i].cause);
    }
}

static void deep_nesting_does_not_exhaust_the_stack(void **state) {
    enum { DEPTH = 1 << 20 };
    static char text[64 + 2 * DEPTH];
    int length = sprintf(text, "{\"asset\":{\"version\":\"2.0\"},\"extras\":");
    memset(text + length, '[', DEPTH);
    gltf_fixture_write_text(*state, "deep.gltf", text);
    gltf_fixture_must_fail(*state, "deep.gltf", LOBE_ERROR_MALFORMED, "nested deeper than");
}

static void control_characters_of_names_stay_out_of_the_log(void **state) {
    gltf_fixture *fixture = *state;
    gltf_fixture_write_text(fixture, "bell.gltf",
                            "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"name\":"
                            "\"a\\u0007\\nb\",\"alphaMode\":\"X\\u001b[31m\"}],\"meshes\":[{"
                            "\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                            "\"material\":0}]}],\"nodes\":[{\"mesh\":0}]}");
    gltf_fixture_must_fail(fixture, "bell.gltf", LOBE_ERROR_MALFORMED,
                           "material 'a??b': unknown alpha mode 'X?[31m'");
}

// ---------------------------------------------------------------------------------------------
// GLB

static const char empty_json[] = "{\"asset\":{\"version\":\"2.0\"}} ";

typedef struct glb_words {
    uint32_t words[32];
    size_t size;
} glb_words;

// Header, the JSON chunk and a binary chunk of 8 bytes.
static glb_words make_glb(void) {
    glb_words glb = {{0x46546c67, 2, 0, 28, 0x4e4f534a}, 0};
    memcpy(glb.words + 5, empty_json, 28);
    glb.words[12] = 8;
    glb.words[13] = 0x004e4942;
    glb.size = 64;
    glb.words[2] = (uint32_t)glb.size;
    return glb;
}

static void broken_chunks_are_refused(void **state) {
    static const struct {
        size_t word;
        uint32_t value;
        lobe_result result;
        const char *cause;
    } cases[] = {
        {1, 1, LOBE_ERROR_UNSUPPORTED, "GLB version 1"},
        {2, 65, LOBE_ERROR_MALFORMED, "shorter than its header says"},
        {2, 0xffffffff, LOBE_ERROR_MALFORMED, "shorter than its header says"},
        {2, 0, LOBE_ERROR_MALFORMED, "ends inside a chunk header"},
        {2, 16, LOBE_ERROR_MALFORMED, "ends inside a chunk header"},
        {2, 40, LOBE_ERROR_MALFORMED, "a chunk is longer than the file"},
        {2, 52, LOBE_ERROR_MALFORMED, "ends inside a chunk header"},
        {3, 0, LOBE_ERROR_MALFORMED, "a chunk is longer than the file"},
        {3, 27, LOBE_ERROR_MALFORMED, "not a multiple of 4"},
        {3, 0xfffffffc, LOBE_ERROR_MALFORMED, "a chunk is longer than the file"},
        {4, 0x004e4942, LOBE_ERROR_MALFORMED, "the first chunk is not JSON"},
        {12, 12, LOBE_ERROR_MALFORMED, "a chunk is longer than the file"},
        {12, 0xfffffff8, LOBE_ERROR_MALFORMED, "a chunk is longer than the file"},
        {12, 7, LOBE_ERROR_MALFORMED, "not a multiple of 4"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glb_words glb = make_glb();
        glb.words[cases[i].word] = cases[i].value;
        gltf_fixture_write(*state, "chunk.glb", glb.words, glb.size);
        gltf_fixture_must_fail(*state, "chunk.glb", cases[i].result, cases[i].cause);
    }
}

static void chunks_that_need_not_be_known_are_skipped(void **state) {
    static const struct {
        size_t word;
        uint32_t value;
    } cases[] = {{12, 8}, {12, 0}, {13, 0x12345678}, {2, 48}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glb_words glb = make_glb();
        glb.words[cases[i].word] = cases[i].value;
        gltf_fixture_write(*state, "chunk.glb", glb.words, glb.size);
        lobe_scene *scene = gltf_fixture_must_open(*state, "chunk.glb");
        assert_int_equal(scene->instance_count, 0);
        lobe_scene_destroy(&scene);
    }
}

static void every_truncation_of_a_glb_is_refused(void **state) {
    const gltf_fixture_mesh mesh = {.accessors = &gltf_fixture_triangle, .accessor_count = 1};
    gltf_fixture_write_mesh(*state, "whole.glb", &mesh);
    char path[512], bytes[4096];
    snprintf(path, sizeof path, "%s", gltf_fixture_path(*state, "whole.glb"));
    FILE *file = fopen(path, "rb");
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    for (size_t length = 0; length < size; length++) {
        lobe_scene *scene;
        gltf_fixture_write(*state, "part.glb", bytes, length);
        assert_int_equal(gltf_fixture_open(*state, "part.glb", &scene), LOBE_ERROR_MALFORMED);
    }
}

// ---------------------------------------------------------------------------------------------
// Buffers, views and accessors. The binary chunk holds three positions and three 16-bit indices.

static const char parts[] =
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"name\":\"part\","
    "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"mode\":4}]}],"
    "\"buffers\":[{\"byteLength\":44}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"
    "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}],\"accessors\":[{\"bufferView\":0,"
    "\"componentType\":5126,\"type\":\"VEC3\",\"count\":3},{\"bufferView\":1,"
    "\"componentType\":5123,\"type\":\"SCALAR\",\"count\":3}]}";

typedef struct parts_content {
    float positions[9];
    uint16_t indices[4];
} parts_content;

static const parts_content good_parts = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 0}};

// Writes the parts with the first `from` in their text replaced by `to`.
static void write_parts(const gltf_fixture *fixture, const char *from, const char *to,
                        const parts_content *content) {
    char json[2048];
    const char *found = strstr(parts, from);
    assert_non_null(found);
    snprintf(json, sizeof json, "%.*s%s%s", (int)(found - parts), parts, to, found + strlen(from));
    gltf_fixture_write_glb(fixture, "parts.glb", json, content, sizeof *content);
}

static void parts_are_good_unless_changed(void **state) {
    write_parts(*state, "", "", &good_parts);
    lobe_scene *scene = gltf_fixture_must_open(*state, "parts.glb");
    assert_int_equal(scene->meshes[0].index_count, 3);
    lobe_scene_destroy(&scene);
}

static void ranges_are_checked_before_memory_is_taken(void **state) {
    static const struct {
        const char *from, *to;
        lobe_result result;
        const char *cause;
    } cases[] = {
        {"\"byteLength\":44", "\"byteLength\":48", LOBE_ERROR_MALFORMED, "byteLength"},
        {"\"byteLength\":44", "\"byteLength\":0", LOBE_ERROR_MALFORMED, ""},
        {"\"byteLength\":44", "\"byteLength\":9007199254740992", LOBE_ERROR_MALFORMED, ""},
        {"\"byteLength\":36", "\"byteLength\":45", LOBE_ERROR_MALFORMED,
         "buffer view 0: 45 bytes from 0 on end beyond the 44 bytes of buffer 0"},
        {"\"byteLength\":36", "\"byteLength\":35", LOBE_ERROR_MALFORMED,
         "POSITION of part: 3 elements end beyond the 35 bytes of buffer view 0"},
        {"\"byteLength\":36", "\"byteLength\":0", LOBE_ERROR_MALFORMED, "end beyond"},
        {"\"byteOffset\":36", "\"byteOffset\":39", LOBE_ERROR_MALFORMED, "buffer view 1"},
        {"\"byteOffset\":36", "\"byteOffset\":9007199254740992", LOBE_ERROR_MALFORMED,
         "buffer view 1"},
        {"\"buffer\":0", "\"buffer\":1", LOBE_ERROR_MALFORMED, "there is no buffer 1"},
        {"\"bufferView\":0", "\"bufferView\":2", LOBE_ERROR_MALFORMED, "there is no buffer view 2"},
        {"\"bufferView\":0", "\"bufferView\":0,\"byteOffset\":4", LOBE_ERROR_MALFORMED,
         "end beyond"},
        {"\"bufferView\":0", "\"bufferView\":0,\"byteOffset\":9007199254740992",
         LOBE_ERROR_MALFORMED, "end beyond"},
        {"\"byteLength\":36", "\"byteLength\":36,\"byteStride\":8", LOBE_ERROR_MALFORMED,
         "overlap at a stride of 8"},
        {"\"byteLength\":36", "\"byteLength\":36,\"byteStride\":16", LOBE_ERROR_MALFORMED,
         "end beyond"},
        {"\"byteLength\":36", "\"byteLength\":36,\"byteStride\":256", LOBE_ERROR_MALFORMED,
         "byteStride"},
        // A 2 GB accessor, and counts whose sizes overflow 32 and 64 bits.
        {"\"count\":3", "\"count\":178956971", LOBE_ERROR_MALFORMED, "end beyond"},
        {"\"count\":3", "\"count\":357913942", LOBE_ERROR_MALFORMED, "end beyond"},
        {"\"count\":3", "\"count\":9007199254740992", LOBE_ERROR_MALFORMED, "end beyond"},
        {"\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3",
         "\"componentType\":5126,\"type\":\"VEC3\",\"count\":178956971", LOBE_ERROR_LIMIT,
         "178956971 elements without a buffer view"},
        {"\"count\":3", "\"count\":0", LOBE_ERROR_MALFORMED, "has no elements"},
        {"\"componentType\":5126", "\"componentType\":5127", LOBE_ERROR_MALFORMED, "type 5127"},
        {"\"componentType\":5126", "\"componentType\":5130", LOBE_ERROR_MALFORMED, "type 5130"},
        {"\"componentType\":5126", "\"componentType\":5123", LOBE_ERROR_MALFORMED,
         "3 components of type 5123 are not allowed"},
        {"\"VEC3\"", "\"VEC2\"", LOBE_ERROR_MALFORMED, "2 components"},
        {"\"VEC3\"", "\"MAT3\"", LOBE_ERROR_MALFORMED, "a matrix"},
        {"\"VEC3\"", "\"VEC9\"", LOBE_ERROR_MALFORMED, "VEC9"},
        {"\"POSITION\":0", "\"POSITION\":2", LOBE_ERROR_MALFORMED, "there is no accessor 2"},
        {"\"POSITION\":0", "\"POSITION\":0,\"NORMAL\":9", LOBE_ERROR_MALFORMED,
         "NORMAL of part: there is no accessor 9"},
        {"\"POSITION\":0", "\"POSITION\":0,\"NORMAL\":1", LOBE_ERROR_MALFORMED,
         "NORMAL of part: 1 components"},
        {"\"indices\":1", "\"indices\":2", LOBE_ERROR_MALFORMED, "out of bounds"},
        {"\"indices\":1", "\"indices\":0", LOBE_ERROR_MALFORMED, "not single unsigned integers"},
        {"\"componentType\":5123", "\"componentType\":5122", LOBE_ERROR_MALFORMED,
         "not single unsigned integers"},
        {"\"type\":\"SCALAR\",\"count\":3", "\"type\":\"SCALAR\",\"count\":2", LOBE_ERROR_MALFORMED,
         "triangles of 2 vertices"},
        {"\"mode\":4", "\"mode\":9", LOBE_ERROR_MALFORMED, "unknown mode 9"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_parts(*state, cases[i].from, cases[i].to, &good_parts);
        gltf_fixture_must_fail(*state, "parts.glb", cases[i].result, cases[i].cause);
    }
}

static void sparse_ranges_are_checked(void **state) {
    // Indices and values are both in view 1: 0, 1, 2 as 16-bit integers.
    static const char sparse[] =
        "\"count\":3,\"sparse\":{\"count\":%s,\"indices\":{\"bufferView\":%s,"
        "\"componentType\":%s},\"values\":{\"bufferView\":%s}}";
    static const struct {
        const char *count, *indices, *component, *values, *cause;
    } cases[] = {
        {"4", "1", "5121", "0", "sparse indices of type"},
        {"3", "1", "5126", "0", "sparse indices of type"},
        {"3", "1", "5125", "0", "end beyond the 6 bytes"},
        {"3", "7", "5123", "0", "there is no buffer view 7"},
        {"3", "1", "5123", "7", "there is no buffer view 7"},
        {"1", "1", "5123", "1", "end beyond the 6 bytes"},
        {"2", "1", "5121", "0", "do not increase"},
        {"1", "0", "5125", "0", NULL},
        {"3", "1", "5123", "0", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char replacement[256];
        snprintf(replacement, sizeof replacement, sparse, cases[i].count, cases[i].indices,
                 cases[i].component, cases[i].values);
        write_parts(*state, "\"count\":3", replacement, &good_parts);
        if (cases[i].cause) {
            gltf_fixture_must_fail(*state, "parts.glb", LOBE_ERROR_MALFORMED, cases[i].cause);
            continue;
        }
        lobe_scene *scene = gltf_fixture_must_open(*state, "parts.glb");
        lobe_scene_destroy(&scene);
    }
    // An index beyond the elements, in the second of two.
    parts_content content = good_parts;
    content.indices[1] = 3;
    char replacement[256];
    snprintf(replacement, sizeof replacement, sparse, "2", "1", "5123", "0");
    write_parts(*state, "\"count\":3", replacement, &content);
    gltf_fixture_must_fail(*state, "parts.glb", LOBE_ERROR_MALFORMED, "sparse index 3 of 3");
}

static void attributes_of_unequal_counts_are_refused(void **state) {
    static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    for (size_t count = 2; count <= 4; count += 2) {
        const gltf_fixture_accessor accessors[] = {
            gltf_fixture_triangle,
            {"NORMAL", GLTF_FLOAT, "VEC3", false, count, normals, 12 * count}};
        const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 2};
        char cause[64];
        snprintf(cause, sizeof cause, "NORMAL of shape: %zu elements for 3 positions", count);
        gltf_fixture_write_mesh(*state, "unequal.glb", &mesh);
        gltf_fixture_must_fail(*state, "unequal.glb", LOBE_ERROR_MALFORMED, cause);
    }
}

static void indices_out_of_range_are_named(void **state) {
    parts_content content = good_parts;
    content.indices[1] = 3;
    write_parts(*state, "", "", &content);
    gltf_fixture_must_fail(*state, "parts.glb", LOBE_ERROR_MALFORMED,
                           "part: index 1 is 3, of 3 vertices");
    content.indices[1] = 0xffff;
    write_parts(*state, "", "", &content);
    gltf_fixture_must_fail(*state, "parts.glb", LOBE_ERROR_MALFORMED, "index 1 is 65535");
}

static void vertices_that_are_not_finite_are_named(void **state) {
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        parts_content content = good_parts;
        content.positions[3 * i + i] = bad[i];
        char cause[64];
        snprintf(cause, sizeof cause, "part: POSITION of vertex %d is not finite", i);
        write_parts(*state, "", "", &content);
        gltf_fixture_must_fail(*state, "parts.glb", LOBE_ERROR_MALFORMED, cause);
    }
    parts_content content = good_parts;
    content.positions[4] = NAN;
    content.positions[0] = 1;
    write_parts(*state, "\"POSITION\":0", "\"NORMAL\":0,\"POSITION\":0", &content);
    gltf_fixture_must_fail(*state, "parts.glb", LOBE_ERROR_MALFORMED, "vertex 1 is not finite");
}

static void positions_beyond_all_measure_are_refused(void **state) {
    parts_content content = good_parts;
    content.positions[3] = 3e38f;
    content.positions[7] = -3e38f;
    write_parts(*state, "", "", &content);
    gltf_fixture_must_fail(*state, "parts.glb", LOBE_ERROR_LIMIT, "farther than");
}

static void alignment_does_not_matter(void **state) {
    struct {
        uint8_t shift[2];
        uint8_t bytes[46];
    } content = {0};
    memcpy(content.bytes, good_parts.positions, 36);
    content.bytes[39] = 1;
    content.bytes[41] = 2;
    const char *json =
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"buffers\":[{\"byteLength\":48}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":2,"
        "\"byteLength\":36},{\"buffer\":0,\"byteOffset\":39,\"byteLength\":6}],\"accessors\":[{"
        "\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3},{"
        "\"bufferView\":1,\"componentType\":5123,\"type\":\"SCALAR\",\"count\":3}]}";
    gltf_fixture_write_glb(*state, "shifted.glb", json, &content, sizeof content);
    lobe_scene *scene = gltf_fixture_must_open(*state, "shifted.glb");
    gltf_fixture_assert_near(scene->meshes[0].vertices[1].position, good_parts.positions + 3, 3, 0);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// External buffers, and the limits of a small file

static void write_external(const gltf_fixture *fixture, const char *uri) {
    char json[1024];
    snprintf(json, sizeof json,
             "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
             "\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"buffers\":[{"
             "\"byteLength\":36%s}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
             "\"count\":3}]}",
             uri);
    gltf_fixture_write_text(fixture, "external.gltf", json);
}

static void external_buffers_are_found_and_measured(void **state) {
    write_external(*state, ",\"uri\":\"ext.bin\"");
    gltf_fixture_must_fail(*state, "external.gltf", LOBE_ERROR_NOT_FOUND, "ext.bin: no such file");
    gltf_fixture_write(*state, "ext.bin", gltf_fixture_triangle.data, 35);
    gltf_fixture_must_fail(*state, "external.gltf", LOBE_ERROR_MALFORMED, "ext.bin");
    gltf_fixture_write_text(*state, "ext.bin", "");
    gltf_fixture_must_fail(*state, "external.gltf", LOBE_ERROR_MALFORMED, "ext.bin");
    gltf_fixture_write(*state, "ext.bin", gltf_fixture_triangle.data, 36);
    lobe_scene *scene = gltf_fixture_must_open(*state, "external.gltf");
    assert_int_equal(scene->instance_count, 1);
    lobe_scene_destroy(&scene);
    write_external(*state, "");
    gltf_fixture_must_fail(*state, "external.gltf", LOBE_ERROR_MALFORMED, "'uri' is missing");
    write_external(*state, ",\"uri\":\"/dev/zero\"");
    gltf_fixture_must_fail(*state, "external.gltf", LOBE_ERROR_NOT_FOUND, "no such file");
    write_external(*state, ",\"uri\":\"../../dev/zero\"");
    gltf_fixture_must_fail(*state, "external.gltf", LOBE_ERROR_READ, "not a regular file");
    write_external(*state, ",\"uri\":\"data:application/octet-stream;base64,AAAA\"");
    gltf_fixture_must_fail(*state, "external.gltf", LOBE_ERROR_MALFORMED, "data:");
}

// One mesh of a thousand primitives with a thousand nodes: slightly over a million instances.
static void instances_are_limited(void **state) {
    enum { COUNT = 1100 };
    static char json[COUNT * 64];
    size_t length = (size_t)sprintf(json, "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}");
    for (int i = 0; i < COUNT; i++)
        length += (size_t)sprintf(json + length, ",{\"mesh\":0}");
    length += (size_t)sprintf(json + length, "],\"meshes\":[{\"primitives\":[");
    for (int i = 0; i < COUNT; i++)
        length +=
            (size_t)sprintf(json + length, "%s{\"attributes\":{\"POSITION\":0}}", i ? "," : "");
    sprintf(json + length,
            "]}],\"buffers\":[{\"byteLength\":36}],\"bufferViews\":[{\"buffer\":0,"
            "\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
            "\"type\":\"VEC3\",\"count\":3}]}");
    gltf_fixture_write_glb(*state, "crowd.glb", json, gltf_fixture_triangle.data, 36);
    gltf_fixture_must_fail(*state, "crowd.glb", LOBE_ERROR_LIMIT, "1048576 instances");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_that_are_not_there_or_cannot_be_read),
        cmocka_unit_test(content_that_is_no_gltf),
        cmocka_unit_test(deep_nesting_does_not_exhaust_the_stack),
        cmocka_unit_test(control_characters_of_names_stay_out_of_the_log),
        cmocka_unit_test(broken_chunks_are_refused),
        cmocka_unit_test(chunks_that_need_not_be_known_are_skipped),
        cmocka_unit_test(every_truncation_of_a_glb_is_refused),
        cmocka_unit_test(parts_are_good_unless_changed),
        cmocka_unit_test(ranges_are_checked_before_memory_is_taken),
        cmocka_unit_test(sparse_ranges_are_checked),
        cmocka_unit_test(attributes_of_unequal_counts_are_refused),
        cmocka_unit_test(indices_out_of_range_are_named),
        cmocka_unit_test(vertices_that_are_not_finite_are_named),
        cmocka_unit_test(positions_beyond_all_measure_are_refused),
        cmocka_unit_test(alignment_does_not_matter),
        cmocka_unit_test(external_buffers_are_found_and_measured),
        cmocka_unit_test(instances_are_limited),
    };
    return cmocka_run_group_tests_name("bad glTF files", tests, gltf_fixture_setup,
                                       gltf_fixture_teardown);
}
