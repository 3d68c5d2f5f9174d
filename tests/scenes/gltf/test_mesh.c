// Meshes of glTF files: how accessors become vertices and triangles.

#include "tests/scenes/gltf/gltf_fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NEAR 1e-6f

static const float quad[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
static const float quad_normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
#define QUAD                                                                                       \
    {"POSITION", GLTF_FLOAT, "VEC3", false, 5, quad, sizeof quad}, {                               \
        "NORMAL", GLTF_FLOAT, "VEC3", false, 5, quad_normals, sizeof quad_normals                  \
    }

static lobe_scene *open_mesh(gltf_fixture *fixture, const gltf_fixture_mesh *mesh) {
    gltf_fixture_write_mesh(fixture, "mesh.glb", mesh);
    return gltf_fixture_must_open(fixture, "mesh.glb");
}

static void assert_indices(const lobe_mesh *mesh, const uint32_t *expected, size_t count) {
    assert_int_equal(mesh->index_count, count);
    assert_memory_equal(mesh->indices, expected, count * sizeof *expected);
}

static void every_index_type_is_read(void **state) {
    const uint8_t bytes[] = {0, 1, 2, 2, 1, 3, 0, 1, 4};
    const uint16_t shorts[] = {0, 1, 2, 2, 1, 3, 0, 1, 4};
    const uint32_t words[] = {0, 1, 2, 2, 1, 3, 0, 1, 4};
    const gltf_fixture_accessor indices[] = {
        {NULL, GLTF_UNSIGNED_BYTE, "SCALAR", false, 9, bytes, sizeof bytes},
        {NULL, GLTF_UNSIGNED_SHORT, "SCALAR", false, 9, shorts, sizeof shorts},
        {NULL, GLTF_UNSIGNED_INT, "SCALAR", false, 9, words, sizeof words},
    };
    for (size_t i = 0; i < 3; i++) {
        const gltf_fixture_accessor accessors[] = {QUAD, indices[i]};
        const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 3};
        lobe_scene *scene = open_mesh(*state, &mesh);
        assert_int_equal(scene->mesh_count, 1);
        assert_string_equal(scene->meshes[0].name, "shape");
        assert_int_equal(scene->meshes[0].vertex_count, 5);
        assert_indices(&scene->meshes[0], words, 9);
        gltf_fixture_assert_near(scene->meshes[0].vertices[3].position, quad + 9, 3, 0);
        lobe_scene_destroy(&scene);
    }
}

static void strips_and_fans_become_lists(void **state) {
    static const float fan[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 0, 0};
    const gltf_fixture_accessor strip_accessors[] = {QUAD};
    const gltf_fixture_accessor fan_accessors[] = {
        {"POSITION", GLTF_FLOAT, "VEC3", false, 5, fan, sizeof fan},
        {"NORMAL", GLTF_FLOAT, "VEC3", false, 5, quad_normals, sizeof quad_normals}};
    const gltf_fixture_mesh strip = {
        .accessors = strip_accessors, .accessor_count = 2, .mode = GLTF_TRIANGLE_STRIP};
    lobe_scene *scene = open_mesh(*state, &strip);
    assert_indices(&scene->meshes[0], (const uint32_t[]){0, 1, 2, 1, 3, 2, 2, 3, 4}, 9);
    lobe_scene_destroy(&scene);
    const gltf_fixture_mesh fan_mesh = {
        .accessors = fan_accessors, .accessor_count = 2, .mode = GLTF_TRIANGLE_FAN};
    scene = open_mesh(*state, &fan_mesh);
    assert_indices(&scene->meshes[0], (const uint32_t[]){1, 2, 0, 2, 3, 0, 3, 4, 0}, 9);
    lobe_scene_destroy(&scene);
}

static void only_used_vertices_are_kept(void **state) {
    const uint8_t bytes[] = {4, 2, 3};
    const gltf_fixture_accessor accessors[] = {
        QUAD, {NULL, GLTF_UNSIGNED_BYTE, "SCALAR", false, 3, bytes, sizeof bytes}};
    const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 3};
    lobe_scene *scene = open_mesh(*state, &mesh);
    assert_int_equal(scene->meshes[0].vertex_count, 3);
    assert_indices(&scene->meshes[0], (const uint32_t[]){0, 1, 2}, 3);
    gltf_fixture_assert_near(scene->meshes[0].vertices[0].position, quad + 12, 3, 0);
    gltf_fixture_assert_near(scene->meshes[0].vertices[1].position, quad + 6, 3, 0);
    gltf_fixture_assert_near(scene->meshes[0].vertices[2].position, quad + 9, 3, 0);
    gltf_fixture_assert_near(scene->minimum, (const float[]){0, 1, 0}, 3, 0);
    gltf_fixture_assert_near(scene->maximum, (const float[]){1, 2, 0}, 3, 0);
    lobe_scene_destroy(&scene);
}

static void coordinates_and_colours_are_normalised(void **state) {
    static const uint8_t first[] = {0, 255, 51, 102, 255, 0};
    static const uint16_t second[] = {65535, 0, 26214, 13107, 0, 65535};
    static const uint8_t colours[] = {255, 0, 51, 255, 255, 255, 0, 0, 0};
    const gltf_fixture_accessor accessors[] = {
        gltf_fixture_triangle,
        {"TEXCOORD_0", GLTF_UNSIGNED_BYTE, "VEC2", true, 3, first, sizeof first},
        {"TEXCOORD_1", GLTF_UNSIGNED_SHORT, "VEC2", true, 3, second, sizeof second},
        {"COLOR_0", GLTF_UNSIGNED_BYTE, "VEC3", true, 3, colours, sizeof colours}};
    const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 4};
    lobe_scene *scene = open_mesh(*state, &mesh);
    const lobe_mesh *m = &scene->meshes[0];
    assert_true(m->has_texture_coordinates[0] && m->has_texture_coordinates[1] && m->has_colour);
    const float expected[3][2] = {{0, 1}, {0.2f, 0.4f}, {1, 0}};
    for (int i = 0; i < 3; i++) {
        gltf_fixture_assert_near(m->vertices[i].texture_coordinates[0], expected[i], 2, NEAR);
        const float swapped[] = {expected[i][1], expected[i][0]};
        gltf_fixture_assert_near(m->vertices[i].texture_coordinates[1], swapped, 2, NEAR);
    }
    gltf_fixture_assert_near(m->vertices[0].colour, (const float[]){1, 0, 0.2f, 1}, 4, NEAR);
    gltf_fixture_assert_near(m->vertices[2].colour, (const float[]){0, 0, 0, 1}, 4, NEAR);
    lobe_scene_destroy(&scene);
}

static void colours_may_have_alpha(void **state) {
    static const float colours[] = {1, 0.5f, 0.25f, 0.125f, 0, 0, 0, 0, 1, 1, 1, 1};
    const gltf_fixture_accessor accessors[] = {
        gltf_fixture_triangle, {"COLOR_0", GLTF_FLOAT, "VEC4", false, 3, colours, sizeof colours}};
    const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 2};
    lobe_scene *scene = open_mesh(*state, &mesh);
    gltf_fixture_assert_near(scene->meshes[0].vertices[0].colour, colours, 4, 0);
    lobe_scene_destroy(&scene);
}

static void quantised_attributes_need_their_extension(void **state) {
    // Positions scaled by the node, as quantising exporters write them; -32768 means -1.
    static const int16_t positions[] = {0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, -32768, 0};
    static const int8_t normals[] = {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0};
    static const uint16_t coordinates[] = {0, 0, 3, 0, 0, 2};
    // Rows of short vectors are padded to four bytes, so a stride is needed.
    const char *json =
        "{\"asset\":{\"version\":\"2.0\"},%s\"nodes\":[{\"mesh\":0,\"scale\":[2,2,2]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,"
        "\"TEXCOORD_0\":2}}]}],\"buffers\":[{\"byteLength\":48}],\"bufferViews\":["
        "{\"buffer\":0,\"byteLength\":24,\"byteStride\":8},"
        "{\"buffer\":0,\"byteOffset\":24,\"byteLength\":12,\"byteStride\":4},"
        "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":12}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5122,\"normalized\":true,\"type\":\"VEC3\","
        "\"count\":3},{\"bufferView\":1,\"componentType\":5120,\"normalized\":true,"
        "\"type\":\"VEC3\",\"count\":3},"
        "{\"bufferView\":2,\"componentType\":5123,\"type\":\"VEC2\",\"count\":3}]}";
    uint8_t binary[48];
    memcpy(binary, positions, 24);
    memcpy(binary + 24, normals, 12);
    memcpy(binary + 36, coordinates, 12);
    char text[2048];
    snprintf(text, sizeof text, json,
             "\"extensionsUsed\":[\"KHR_mesh_quantization\"],"
             "\"extensionsRequired\":[\"KHR_mesh_quantization\"],");
    gltf_fixture_write_glb(*state, "quantised.glb", text, binary, sizeof binary);
    lobe_scene *scene = gltf_fixture_must_open(*state, "quantised.glb");
    const lobe_scene_vertex *v = scene->meshes[0].vertices;
    gltf_fixture_assert_near(v[1].position, (const float[]){1, 0, 0}, 3, NEAR);
    gltf_fixture_assert_near(v[2].position, (const float[]){0, 1, -1}, 3, NEAR);
    gltf_fixture_assert_near(v[2].normal, (const float[]){0, 0, 1}, 3, NEAR);
    gltf_fixture_assert_near(v[1].texture_coordinates[0], (const float[]){3, 0}, 2, 0);
    gltf_fixture_assert_near(scene->maximum, (const float[]){2, 2, 0}, 3, NEAR);
    lobe_scene_destroy(&scene);
    snprintf(text, sizeof text, json, "");
    gltf_fixture_write_glb(*state, "plain.glb", text, binary, sizeof binary);
    gltf_fixture_must_fail(*state, "plain.glb", LOBE_ERROR_MALFORMED, "POSITION of mesh 0");
}

static void interleaved_attributes_are_read_at_their_stride(void **state) {
    static const float rows[] = {0, 0, 0, 0, 0, 1, 0.5f, 0.25f, 1, 0, 0, 0,
                                 0, 1, 1, 0, 0, 1, 0,    0,     0, 1, 0, 1};
    const char *json =
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":"
        "[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2}}]}],"
        "\"buffers\":[{\"byteLength\":96}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":96,"
        "\"byteStride\":32}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3},"
        "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"type\":\"VEC3\","
        "\"count\":3},{\"bufferView\":0,\"byteOffset\":24,\"componentType\":5126,"
        "\"type\":\"VEC2\",\"count\":3}]}";
    gltf_fixture_write_glb(*state, "rows.glb", json, rows, sizeof rows);
    lobe_scene *scene = gltf_fixture_must_open(*state, "rows.glb");
    for (int i = 0; i < 3; i++) {
        const lobe_scene_vertex *v = &scene->meshes[0].vertices[i];
        gltf_fixture_assert_near(v->position, rows + 8 * i, 3, 0);
        gltf_fixture_assert_near(v->normal, rows + 8 * i + 3, 3, 0);
        gltf_fixture_assert_near(v->texture_coordinates[0], rows + 8 * i + 6, 2, 0);
    }
    lobe_scene_destroy(&scene);
}

// Four positions, of which sparse values replace the second and the last; `base` is a buffer view
// or none, in which case the others are zero.
static const char sparse_json[] =
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":"
    "[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"mode\":5}]}],"
    "\"buffers\":[{\"byteLength\":124}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":4},"
    "{\"buffer\":0,\"byteOffset\":100,\"byteLength\":24}],\"accessors\":[{%s"
    "\"componentType\":5126,\"type\":\"VEC3\",\"count\":4,\"sparse\":{\"count\":2,"
    "\"indices\":{\"bufferView\":2,\"componentType\":5123},\"values\":{\"bufferView\":3}}},"
    "{\"bufferView\":1,\"componentType\":5126,\"type\":\"VEC3\",\"count\":4}]}";

typedef struct sparse_content {
    float positions[12], normals[12];
    uint16_t indices[2];
    float values[6];
} sparse_content;

static const sparse_content sparse = {
    {0, 0, 0, 9, 9, 9, 0, 1, 0, 9, 9, 9},
    {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1},
    {1, 3},
    {1, 0, 0, 1, 1, 0},
};

static lobe_scene *open_sparse(gltf_fixture *fixture, const char *base) {
    char json[2048];
    snprintf(json, sizeof json, sparse_json, base);
    gltf_fixture_write_glb(fixture, "sparse.glb", json, &sparse, sizeof sparse);
    return gltf_fixture_must_open(fixture, "sparse.glb");
}

static void sparse_values_replace_those_of_the_view(void **state) {
    lobe_scene *scene = open_sparse(*state, "\"bufferView\":0,");
    static const float expected[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    assert_int_equal(scene->meshes[0].vertex_count, 4);
    for (int i = 0; i < 4; i++)
        gltf_fixture_assert_near(scene->meshes[0].vertices[i].position, expected[i], 3, 0);
    lobe_scene_destroy(&scene);
}

static void sparse_values_may_stand_alone(void **state) {
    lobe_scene *scene = open_sparse(*state, "");
    static const float expected[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 0}};
    for (int i = 0; i < 4; i++)
        gltf_fixture_assert_near(scene->meshes[0].vertices[i].position, expected[i], 3, 0);
    lobe_scene_destroy(&scene);
}

static void missing_normals_are_flat(void **state) {
    // Two triangles with a common edge, at a right angle.
    static const float bent[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const uint8_t indices[] = {0, 1, 2, 0, 3, 1};
    const gltf_fixture_accessor accessors[] = {
        {"POSITION", GLTF_FLOAT, "VEC3", false, 4, bent, sizeof bent},
        {NULL, GLTF_UNSIGNED_BYTE, "SCALAR", false, 6, indices, sizeof indices}};
    const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 2};
    lobe_scene *scene = open_mesh(*state, &mesh);
    assert_int_equal(scene->meshes[0].vertex_count, 6);
    for (int i = 0; i < 6; i++) {
        const float expected[3] = {0, i < 3 ? 0 : 1, i < 3 ? 1 : 0};
        gltf_fixture_assert_near(scene->meshes[0].vertices[i].normal, expected, 3, NEAR);
        assert_true(scene->meshes[0].vertices[i].tangent[3] == 1);
    }
    lobe_scene_destroy(&scene);
}

static void zero_normals_and_flat_triangles_are_mended_and_counted(void **state) {
    static const float normals[] = {0, 0, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    static const uint8_t indices[] = {0, 1, 2, 2, 1, 3, 0, 0, 1, 0, 2, 4};
    const gltf_fixture_accessor accessors[] = {
        {"POSITION", GLTF_FLOAT, "VEC3", false, 5, quad, sizeof quad},
        {"NORMAL", GLTF_FLOAT, "VEC3", false, 5, normals, sizeof normals},
        {NULL, GLTF_UNSIGNED_BYTE, "SCALAR", false, 12, indices, sizeof indices}};
    const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 3};
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_mesh(fixture, &mesh);
    assert_int_equal(fixture->warnings, 2);
    assert_non_null(strstr(fixture->warnings_text, "2 degenerate triangles"));
    assert_non_null(strstr(fixture->warnings_text, "2 normals of length zero"));
    assert_indices(&scene->meshes[0], (const uint32_t[]){0, 1, 2, 2, 1, 3}, 6);
    for (int i = 0; i < 5; i++)
        gltf_fixture_assert_near(scene->meshes[0].vertices[i].normal, (const float[]){0, 0, 1}, 3,
                                 NEAR);
    lobe_scene_destroy(&scene);
}

static void tangents_of_the_file_are_made_orthonormal(void **state) {
    static const float tangents[] = {2, 0, 1, -1, 0, 3, 0, 1, 1, 1, 5, -0.5f};
    const gltf_fixture_accessor accessors[] = {
        gltf_fixture_triangle,
        {"NORMAL", GLTF_FLOAT, "VEC3", false, 3, quad_normals, 36},
        {"TANGENT", GLTF_FLOAT, "VEC4", false, 3, tangents, sizeof tangents}};
    const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 3};
    lobe_scene *scene = open_mesh(*state, &mesh);
    const lobe_scene_vertex *v = scene->meshes[0].vertices;
    const float half = sqrtf(0.5f);
    gltf_fixture_assert_near(v[0].tangent, (const float[]){1, 0, 0, -1}, 4, NEAR);
    gltf_fixture_assert_near(v[1].tangent, (const float[]){0, 1, 0, 1}, 4, NEAR);
    gltf_fixture_assert_near(v[2].tangent, (const float[]){half, half, 0, -1}, 4, NEAR);
    lobe_scene_destroy(&scene);
}

static void tangents_without_direction_are_recomputed(void **state) {
    static const float tangents[] = {0, 0, 0, 1, 0, 0, 7, 1, 1, 0, 0, 1};
    static const float coordinates[] = {0, 1, 0, 0, 1, 1};
    const gltf_fixture_accessor accessors[] = {
        gltf_fixture_triangle,
        {"NORMAL", GLTF_FLOAT, "VEC3", false, 3, quad_normals, 36},
        {"TANGENT", GLTF_FLOAT, "VEC4", false, 3, tangents, sizeof tangents},
        {"TEXCOORD_0", GLTF_FLOAT, "VEC2", false, 3, coordinates, sizeof coordinates}};
    const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 4};
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_mesh(fixture, &mesh);
    assert_non_null(strstr(fixture->warnings_text, "2 tangents without a direction"));
    // u grows along y, v falls along x: seen from the front, the image is mirrored.
    for (int i = 0; i < 3; i++)
        gltf_fixture_assert_near(scene->meshes[0].vertices[i].tangent, (const float[]){0, 1, 0, -1},
                                 4, NEAR);
    lobe_scene_destroy(&scene);
}

// As in "a flat triangle" of tests/scenes/mesh/mikktspace.txt: the second triangle is not drawn,
// but joins the third and fourth to the first.
static void flat_triangles_join_the_tangents_around_them(void **state) {
    static const float positions[] = {0, 0, 0, 2, 0, 0, 1, 0, 0, 0, 0, -2, 1, 0, 2};
    static const float normals[] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    static const float coordinates[] = {0, 0, 1, 0, 0.5f, 0.1f, 0, 1, 0.4f, -1};
    static const uint8_t indices[] = {0, 1, 3, 0, 2, 1, 0, 4, 2, 2, 4, 1};
    const gltf_fixture_accessor accessors[] = {
        {"POSITION", GLTF_FLOAT, "VEC3", false, 5, positions, sizeof positions},
        {"NORMAL", GLTF_FLOAT, "VEC3", false, 5, normals, sizeof normals},
        {"TEXCOORD_0", GLTF_FLOAT, "VEC2", false, 5, coordinates, sizeof coordinates},
        {NULL, GLTF_UNSIGNED_BYTE, "SCALAR", false, 12, indices, sizeof indices}};
    const gltf_fixture_mesh mesh = {.accessors = accessors, .accessor_count = 4};
    lobe_scene *scene = open_mesh(*state, &mesh);
    assert_int_equal(scene->meshes[0].vertex_count, 5);
    assert_indices(&scene->meshes[0], (const uint32_t[]){0, 1, 3, 0, 4, 2, 2, 4, 1}, 9);
    gltf_fixture_assert_near(scene->meshes[0].vertices[0].tangent,
                             (const float[]){0.99724f, 0, 0.07425f, -1}, 4, 1e-4f);
    gltf_fixture_assert_near(scene->meshes[0].vertices[1].tangent,
                             (const float[]){0.99447f, 0, -0.10506f, -1}, 4, 1e-4f);
    lobe_scene_destroy(&scene);
}

static void parts_that_cannot_be_drawn_are_named_once(void **state) {
    const char *json =
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_materials_clearcoat\"],"
        "\"animations\":[{\"channels\":[],\"samplers\":[]}],"
        "\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"skin\":0}],\"skins\":[{\"joints\":[0]}],"
        "\"meshes\":[{\"primitives\":["
        "{\"attributes\":{\"POSITION\":0},\"mode\":0},{\"attributes\":{\"POSITION\":0},"
        "\"mode\":1},{\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":0,\"TEXCOORD_0\":"
        "0}]}]}],"
        "\"buffers\":[{\"byteLength\":36}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
        "\"count\":3}]}";
    gltf_fixture *fixture = *state;
    gltf_fixture_write_glb(fixture, "parts.glb", json, gltf_fixture_triangle.data, 36);
    lobe_scene *scene = gltf_fixture_must_open(fixture, "parts.glb");
    assert_int_equal(scene->mesh_count, 1);
    assert_int_equal(scene->instance_count, 2);
    assert_int_equal(fixture->warnings, 1);
    const char *parts[] = {"KHR_materials_clearcoat", "points and lines",
                           "morph targets of colours or coordinates",
                           "skins of meshes without joints"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        assert_non_null(strstr(fixture->warnings_text, parts[i]));
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_index_type_is_read),
        cmocka_unit_test(strips_and_fans_become_lists),
        cmocka_unit_test(only_used_vertices_are_kept),
        cmocka_unit_test(coordinates_and_colours_are_normalised),
        cmocka_unit_test(colours_may_have_alpha),
        cmocka_unit_test(quantised_attributes_need_their_extension),
        cmocka_unit_test(interleaved_attributes_are_read_at_their_stride),
        cmocka_unit_test(sparse_values_replace_those_of_the_view),
        cmocka_unit_test(sparse_values_may_stand_alone),
        cmocka_unit_test(missing_normals_are_flat),
        cmocka_unit_test(zero_normals_and_flat_triangles_are_mended_and_counted),
        cmocka_unit_test(tangents_of_the_file_are_made_orthonormal),
        cmocka_unit_test(tangents_without_direction_are_recomputed),
        cmocka_unit_test(flat_triangles_join_the_tangents_around_them),
        cmocka_unit_test(parts_that_cannot_be_drawn_are_named_once),
    };
    return cmocka_run_group_tests_name("glTF meshes", tests, gltf_fixture_setup,
                                       gltf_fixture_teardown);
}
