#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "scenes/mesh/mesh.h"
#include "tests/engine/support/log_recorder.h"
#include "tools/scenes/mesh_formats.h"

static const char pyramid[] = "ply\nformat ascii 1.0\ncomment a pyramid on a square\n"
                              "element vertex 5\nproperty float x\nproperty float y\n"
                              "property uchar red\nproperty double z\n"
                              "element edge 1\nproperty int a\nproperty list uchar int b\n"
                              "element face 5\nproperty list uchar int vertex_indices\n"
                              "end_header\n"
                              "0 0 255 0\n1 0 255 0\n1 1 255 0\n0 1 255 0\n.5 .5 9 1e0\n"
                              "1 2 3 4\n"
                              "4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

static void must_read(const void *bytes, size_t size, lobe_mesh *mesh) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_result result = ply_read(bytes, size, "m.ply", &recorder.host, mesh);
    if (result != LOBE_OK)
        fail_msg("%s", recorder.last_error);
    assert_int_equal(recorder.errors, 0);
}

static void must_fail(const void *bytes, size_t size, lobe_result expected, const char *cause) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_mesh mesh;
    assert_int_equal(ply_read(bytes, size, "m.ply", &recorder.host, &mesh), expected);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "m.ply"));
    if (!strstr(recorder.last_error, cause))
        fail_msg("no '%s' in: %s", cause, recorder.last_error);
    assert_null(mesh.vertices);
}

static void assert_is_pyramid(lobe_mesh *mesh) {
    static const float positions[5][3] = {
        {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 1}};
    static const uint32_t indices[18] = {3, 2, 1, 3, 1, 0, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    assert_int_equal(mesh->vertex_count, 5);
    assert_int_equal(mesh->index_count, 18);
    for (int i = 0; i < 5; i++)
        assert_memory_equal(mesh->vertices[i].position, positions[i], sizeof *positions);
    assert_memory_equal(mesh->indices, indices, sizeof indices);
    assert_true(mesh->vertices[4].normal[2] == 1);
    scenes_mesh_free(mesh);
}

static void text_is_read(void **state) {
    (void)state;
    lobe_mesh mesh;
    must_read(pyramid, sizeof pyramid - 1, &mesh);
    assert_is_pyramid(&mesh);
}

// Line ends of other systems.
static void carriage_returns_are_space(void **state) {
    (void)state;
    char text[2 * sizeof pyramid];
    size_t size = 0;
    for (const char *at = pyramid; *at; at++) {
        if (*at == '\n')
            text[size++] = '\r';
        text[size++] = *at;
    }
    lobe_mesh mesh;
    must_read(text, size, &mesh);
    assert_is_pyramid(&mesh);
}

typedef struct byte_buffer {
    uint8_t bytes[4096];
    size_t size;
} byte_buffer;

static void put(byte_buffer *buffer, const void *bytes, size_t size) {
    memcpy(buffer->bytes + buffer->size, bytes, size);
    buffer->size += size;
}

static void put_text(byte_buffer *buffer, const char *text) {
    put(buffer, text, strlen(text));
}

// Numbers with the low byte first, independent of this machine.
static void put_number(byte_buffer *buffer, uint64_t bits, size_t size) {
    for (size_t i = 0; i < size; i++)
        buffer->bytes[buffer->size++] = (uint8_t)(bits >> 8 * i);
}

static void put_float(byte_buffer *buffer, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_number(buffer, bits, 4);
}

static void put_double(byte_buffer *buffer, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_number(buffer, bits, 8);
}

// The pyramid, with numbers of every type.
static void make_binary(byte_buffer *buffer, float first_x) {
    static const float positions[5][3] = {
        {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 1}};
    static const uint8_t polygons[5][5] = {
        {4, 3, 2, 1, 0}, {3, 0, 1, 4}, {3, 1, 2, 4}, {3, 2, 3, 4}, {3, 3, 0, 4}};
    buffer->size = 0;
    put_text(buffer, "ply\nformat binary_little_endian 1.0\nelement face 5\n"
                     "property list uint8 ushort vertex_index\nproperty int8 flag\n"
                     "element vertex 5\nproperty short s\nproperty float32 x\nproperty float64 y\n"
                     "property list uint int extra\nproperty float z\nend_header\n");
    for (int i = 0; i < 5; i++) {
        put_number(buffer, polygons[i][0], 1);
        for (int k = 1; k <= polygons[i][0]; k++)
            put_number(buffer, polygons[i][k], 2);
        put_number(buffer, 0xff, 1);
    }
    for (int i = 0; i < 5; i++) {
        put_number(buffer, 0x8000, 2);
        put_float(buffer, i == 0 ? first_x : positions[i][0]);
        put_double(buffer, positions[i][1]);
        put_number(buffer, (uint64_t)i, 4);
        for (int k = 0; k < i; k++)
            put_number(buffer, 7, 4);
        put_float(buffer, positions[i][2]);
    }
}

static void bytes_are_read(void **state) {
    (void)state;
    byte_buffer buffer;
    make_binary(&buffer, 0);
    lobe_mesh mesh;
    must_read(buffer.bytes, buffer.size, &mesh);
    assert_is_pyramid(&mesh);
}

static void bytes_that_end_early_fail(void **state) {
    (void)state;
    byte_buffer buffer;
    make_binary(&buffer, 0);
    for (size_t size = 0; size < buffer.size; size++) {
        log_recorder recorder;
        log_recorder_start(&recorder);
        lobe_mesh mesh;
        assert_int_not_equal(ply_read(buffer.bytes, size, "m.ply", &recorder.host, &mesh), LOBE_OK);
        assert_int_equal(recorder.errors, 1);
    }
    must_fail(buffer.bytes, buffer.size - 1, LOBE_ERROR_MALFORMED, "vertex 4: the file ends early");
}

static void positions_must_be_finite(void **state) {
    (void)state;
    byte_buffer buffer;
    make_binary(&buffer, NAN);
    must_fail(buffer.bytes, buffer.size, LOBE_ERROR_MALFORMED, "vertex 0: its position");
    make_binary(&buffer, -INFINITY);
    must_fail(buffer.bytes, buffer.size, LOBE_ERROR_MALFORMED, "vertex 0: its position");
}

#define VERTICES  "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define FACES     "element face 1\nproperty list uchar int vertex_indices\n"
#define POSITIONS "0 0 0\n1 0 0\n0 1 0\n"

static void broken_text_is_named(void **state) {
    (void)state;
    static const struct {
        const char *text;
        lobe_result result;
        const char *cause;
    } cases[] = {
        {"", LOBE_ERROR_MALFORMED, "line 1: the file ends"},
        {"plz\n", LOBE_ERROR_UNSUPPORTED, "not a PLY file"},
        {"ply\nformat binary_big_endian 1.0\n", LOBE_ERROR_UNSUPPORTED, "line 2"},
        {"ply\nformat ascii 2.0\n", LOBE_ERROR_UNSUPPORTED, "version"},
        {"ply\nformat ascii 1.0\nelement vertex\nend_header\n", LOBE_ERROR_MALFORMED, "COUNT"},
        {"ply\nelement vertex -1\nend_header\n", LOBE_ERROR_MALFORMED, "COUNT"},
        {"ply\nproperty float x\nend_header\n", LOBE_ERROR_MALFORMED, "outside of an element"},
        {"ply\nelement vertex 1\nproperty half x\n", LOBE_ERROR_MALFORMED, "type"},
        {"ply\nelement vertex 1\nproperty list uchar x\n", LOBE_ERROR_MALFORMED, "property list"},
        {"ply\nsurprise\n", LOBE_ERROR_MALFORMED, "line 2: neither"},
        {"ply\n" VERTICES FACES "end_header\n" POSITIONS "3 0 1 2\n", LOBE_ERROR_MALFORMED,
         "no format"},
        {"ply\nformat ascii 1.0\n" FACES "end_header\n3 0 1 2\n", LOBE_ERROR_MALFORMED, "'vertex'"},
        {"ply\nformat ascii 1.0\n" VERTICES "end_header\n" POSITIONS, LOBE_ERROR_MALFORMED,
         "'face'"},
        {"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n0\n",
         LOBE_ERROR_MALFORMED, "claims more"},
        {"ply\nformat ascii 1.0\nelement x 3\nend_header\n0 0 0\n", LOBE_ERROR_MALFORMED,
         "claims more"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n",
         LOBE_ERROR_MALFORMED, "vertex 1: not a number"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n0 0 0\n1 0 1e39\n0 1 0\n3 0 1 2\n",
         LOBE_ERROR_MALFORMED, "vertex 1: not a number"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n" POSITIONS "3 0 1\n",
         LOBE_ERROR_MALFORMED, "face 0: the file ends early"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n" POSITIONS "3 0 1 -2\n",
         LOBE_ERROR_MALFORMED, "face 0: an index"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n" POSITIONS "3 0 1 1.5\n",
         LOBE_ERROR_MALFORMED, "face 0: an index"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n" POSITIONS "3 0 1 3\n",
         LOBE_ERROR_MALFORMED, "vertex 3"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n" POSITIONS "2 0 1\n",
         LOBE_ERROR_MALFORMED, "no triangles"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n" POSITIONS "3 0 1 1\n",
         LOBE_ERROR_MALFORMED, "no triangle has an area"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES "end_header\n" POSITIONS "4294967295 0 1 2\n",
         LOBE_ERROR_MALFORMED, "ends early"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        must_fail(cases[i].text, strlen(cases[i].text), cases[i].result, cases[i].cause);
}

static void headers_have_limits(void **state) {
    (void)state;
    byte_buffer buffer = {.size = 0};
    put_text(&buffer, "ply\nformat ascii 1.0\n");
    for (int i = 0; i < 17; i++)
        put_text(&buffer, "element e 0\n");
    must_fail(buffer.bytes, buffer.size, LOBE_ERROR_LIMIT, "16 elements");
    buffer.size = 0;
    put_text(&buffer, "ply\nformat ascii 1.0\nelement vertex 3\n");
    for (int i = 0; i < 65; i++)
        put_text(&buffer, "property float p\n");
    must_fail(buffer.bytes, buffer.size, LOBE_ERROR_LIMIT, "64 properties");
}

// Whatever the bytes, the result is a mesh or one message.
static void mutate(const void *original, size_t full, random_sequence *sequence) {
    uint8_t bytes[4096];
    size_t size = full;
    memcpy(bytes, original, full);
    for (uint32_t changes = scenes_random_bits(sequence) % 4; changes > 0; changes--)
        bytes[scenes_random_bits(sequence) % full] = (uint8_t)scenes_random_bits(sequence);
    if (scenes_random_bits(sequence) % 2)
        size = scenes_random_bits(sequence) % (full + 1);
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_mesh mesh;
    lobe_result result = ply_read(bytes, size, "m.ply", &recorder.host, &mesh);
    assert_int_equal(recorder.errors, result != LOBE_OK);
    assert_true((result == LOBE_OK) == (mesh.vertices != NULL));
    scenes_mesh_free(&mesh);
}

static void mutations_do_no_harm(void **state) {
    (void)state;
    random_sequence sequence = scenes_random_start(12);
    byte_buffer binary;
    make_binary(&binary, 0);
    for (int i = 0; i < 10000; i++) {
        mutate(pyramid, sizeof pyramid - 1, &sequence);
        mutate(binary.bytes, binary.size, &sequence);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_read),
        cmocka_unit_test(carriage_returns_are_space),
        cmocka_unit_test(bytes_are_read),
        cmocka_unit_test(bytes_that_end_early_fail),
        cmocka_unit_test(positions_must_be_finite),
        cmocka_unit_test(broken_text_is_named),
        cmocka_unit_test(headers_have_limits),
        cmocka_unit_test(mutations_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
