#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/file.h>

#include "scenes/mesh/mesh.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"
#include "tests/scenes/scene/scene_check.h"
#include "tools/scenes/asset_mesh.h"

// A tetrahedron, 2 metres high, away from the origin.
static const char tetrahedron[] = "positions=[[1,2,3],[2,2,3],[1,2,4],[1,4,3]]\n"
                                  "cells=[[0,1,2],[0,2,3],[0,3,1],[1,3,2]]\n";

// The same, packed by gzip.
static const uint8_t packed[78] = {
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0xff, 0x2b, 0xc8, 0x2f, 0xce, 0x2c, 0xc9,
    0xcc, 0xcf, 0x2b, 0xb6, 0x8d, 0x8e, 0x36, 0xd4, 0x31, 0xd2, 0x31, 0x8e, 0xd5, 0x89, 0x36, 0x82,
    0xd2, 0x20, 0xbe, 0x09, 0x98, 0x36, 0x01, 0xf2, 0x63, 0xb9, 0x92, 0x53, 0x73, 0x72, 0x40, 0xea,
    0x0c, 0x74, 0x80, 0x32, 0x40, 0x71, 0x03, 0xa8, 0x3a, 0x03, 0x1d, 0x63, 0x1d, 0x43, 0xb0, 0x3a,
    0x63, 0xa0, 0x78, 0x2c, 0x17, 0x00, 0xd0, 0x64, 0xd7, 0x84, 0x54, 0x00, 0x00, 0x00};

static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 4\n"
                          "property list uchar int vertex_indices\nend_header\n"
                          "1 2 3\n2 2 3\n1 2 4\n1 4 3\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n";

static const asset_mesh wanted = {.scene = "test", .file = "m", .height = 0.5, .tile = 0.125};

static void write_file(const void *bytes, size_t size) {
    FILE *file = fopen(temporary_folder_file(&test_folder, "m"), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void load(lobe_result expected, const char *assets, const char *cause, lobe_mesh *mesh) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_result result = asset_mesh_load(&wanted, assets, &recorder.host, mesh);
    if (result != expected)
        fail_msg("%s", recorder.last_error);
    assert_int_equal(recorder.errors, expected != LOBE_OK);
    if (expected != LOBE_OK && !strstr(recorder.last_error, cause))
        fail_msg("no '%s' in: %s", cause, recorder.last_error);
    assert_true((mesh->vertices != NULL) == (expected == LOBE_OK));
}

static void a_mesh_stands_on_the_ground_with_its_height(void **state) {
    (void)state;
    const struct {
        const void *bytes;
        size_t size;
    } files[] = {
        {tetrahedron, sizeof tetrahedron - 1}, {packed, sizeof packed}, {ply, sizeof ply - 1}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        lobe_mesh mesh;
        write_file(files[i].bytes, files[i].size);
        load(LOBE_OK, test_folder.path, "", &mesh);
        scenes_mesh_compute_bounds(&mesh);
        const float low[3] = {-0.125f, 0, -0.125f}, high[3] = {0.125f, 0.5f, 0.125f};
        assert_memory_equal(mesh.minimum, low, sizeof low);
        assert_memory_equal(mesh.maximum, high, sizeof high);
        assert_int_equal(mesh.index_count, 12);
        assert_true(mesh.has_texture_coordinates[0]);
        // The edge along +X is 0.25 metres long.
        const lobe_scene_vertex *a = &mesh.vertices[mesh.indices[0]];
        const lobe_scene_vertex *b = &mesh.vertices[mesh.indices[1]];
        assert_true(fabsf(b->texture_coordinates[0][0] - a->texture_coordinates[0][0]) == 2);
        scenes_mesh_free(&mesh);
    }
}

static void what_is_missing_is_said_with_how_to_give_it(void **state) {
    (void)state;
    lobe_mesh mesh;
    load(LOBE_ERROR_NOT_FOUND, NULL, "LOBE_ASSETS", &mesh);
    load(LOBE_ERROR_NOT_FOUND, NULL, "scene 'test'", &mesh);
    load(LOBE_ERROR_NOT_FOUND, test_folder.path, "LOBE_ASSETS", &mesh);
    load(LOBE_ERROR_NOT_FOUND, test_folder.path, test_folder.path, &mesh);
    load(LOBE_ERROR_NOT_FOUND, "/nonexistent", "/nonexistent/m: no such file", &mesh);
    assert_int_equal(mkdir(temporary_folder_file(&test_folder, "m"), 0700), 0);
    load(LOBE_ERROR_READ, test_folder.path, "file", &mesh);
    assert_int_equal(rmdir(temporary_folder_file(&test_folder, "m")), 0);
}

static void broken_files_are_named(void **state) {
    (void)state;
    lobe_mesh mesh;
    write_file("", 0);
    load(LOBE_ERROR_MALFORMED, test_folder.path, "/m: no array", &mesh);
    write_file(ply, sizeof ply - 8);
    load(LOBE_ERROR_MALFORMED, test_folder.path, "ends early", &mesh);
    for (size_t size = 2; size < sizeof packed; size++) {
        write_file(packed, size);
        load(LOBE_ERROR_MALFORMED, test_folder.path, "/m: ends early", &mesh);
    }
    for (size_t i = 0; i < sizeof packed; i++) {
        uint8_t bytes[sizeof packed];
        memcpy(bytes, packed, sizeof packed);
        bytes[i] ^= 0x10;
        // gzip does not check the time and the operating system.
        if (i >= 4 && i < 10)
            continue;
        write_file(bytes, sizeof bytes);
        load(LOBE_ERROR_MALFORMED, test_folder.path, "/m: ", &mesh);
    }
    // Followed by bytes that are no further member.
    uint8_t longer[sizeof packed + 3] = {0};
    memcpy(longer, packed, sizeof packed);
    write_file(longer, sizeof longer);
    load(LOBE_ERROR_MALFORMED, test_folder.path, "/m: ", &mesh);
}

static lobe_result work_with_mesh(void *user, const lobe_host *host) {
    (void)user;
    lobe_mesh mesh;
    lobe_result result = asset_mesh_load(&wanted, test_folder.path, host, &mesh);
    scenes_mesh_free(&mesh);
    return result;
}

static void meshes_of_files_say_where_memory_ends(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "m");
    lobe_file_write(path, tetrahedron, sizeof tetrahedron - 1, NULL);
    const size_t plain = fail_each_allocation(work_with_mesh, NULL);
    assert_true(plain > 15);
    lobe_file_write(path, packed, sizeof packed, NULL);
    assert_true(fail_each_allocation(work_with_mesh, NULL) > plain);
    lobe_file_write(path, ply, sizeof ply - 1, NULL);
    assert_true(fail_each_allocation(work_with_mesh, NULL) > 15);
}

// The real meshes, if available.
static void real_meshes_are_sound(void **state) {
    (void)state;
    static const struct {
        asset_mesh mesh;
        size_t triangles;
    } real[] = {{{"test", "models/npm_bunny.js", 1, 0.25}, 3674},
                {{"test", "models/npm_dragon_vrip_res3.ply.gz", 1, 0.25}, 47794}};
    if (access(LOBE_TEST_ASSETS, R_OK) != 0)
        skip();
    for (size_t i = 0; i < sizeof real / sizeof *real; i++) {
        lobe_mesh mesh;
        assert_int_equal(asset_mesh_load(&real[i].mesh, LOBE_TEST_ASSETS, NULL, &mesh), LOBE_OK);
        scenes_mesh_compute_bounds(&mesh);
        assert_true(mesh.minimum[1] == 0 && fabsf(mesh.maximum[1] - 1) < 1e-6f);
        print_message("# %zu triangles, %zu vertices\n", mesh.index_count / 3, mesh.vertex_count);
        assert_in_range(mesh.index_count / 3, real[i].triangles - 20, real[i].triangles);
        scenes_mesh_free(&mesh);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(a_mesh_stands_on_the_ground_with_its_height),
        IN_TEST_FOLDER(what_is_missing_is_said_with_how_to_give_it),
        IN_TEST_FOLDER(broken_files_are_named),
        IN_TEST_FOLDER(meshes_of_files_say_where_memory_ends),
        cmocka_unit_test(real_meshes_are_sound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
