#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "scenes/builtin/random.h"
#include "scenes/mesh/mesh.h"
#include "tests/engine/support/log_recorder.h"
#include "tools/scenes/mesh_formats.h"

static const char tetrahedron[] = "exports.positions=[[0,0,0],[1,0,0],[0,1.5,0],[0,0,-1e0]]\n"
                                  "exports.cells=[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]\n";

static void must_read(const char *text, lobe_mesh *mesh) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_int_equal(javascript_mesh_read(text, strlen(text), "m.js", &recorder.host, mesh),
                     LOBE_OK);
    assert_int_equal(recorder.errors, 0);
}

static void must_fail(const char *text, const char *cause) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_mesh mesh;
    assert_int_equal(javascript_mesh_read(text, strlen(text), "m.js", &recorder.host, &mesh),
                     LOBE_ERROR_MALFORMED);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "m.js"));
    if (!strstr(recorder.last_error, cause))
        fail_msg("no '%s' in: %s", cause, recorder.last_error);
    assert_null(mesh.vertices);
    assert_null(mesh.indices);
}

static void a_module_is_read(void **state) {
    (void)state;
    lobe_mesh mesh;
    must_read(tetrahedron, &mesh);
    assert_int_equal(mesh.vertex_count, 4);
    assert_int_equal(mesh.index_count, 12);
    assert_true(mesh.vertices[2].position[1] == 1.5f && mesh.vertices[3].position[2] == -1);
    const uint32_t indices[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    assert_memory_equal(mesh.indices, indices, sizeof indices);
    assert_false(mesh.has_texture_coordinates[0]);
    scenes_mesh_free(&mesh);
}

static void other_ways_to_write_it_are_read(void **state) {
    (void)state;
    static const char *const texts[] = {
        "{\"cells\": [[0, 1, 2]], \"positions\": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}",
        "module.exports = { 'positions' : [ [0,0,0,] , [1,0,0], [0,1,0], ], cells : [[0,1,2],], }",
        // Names that only begin or end like these, and mentions without a value.
        ("// positions and cells\nvar npositions=[7], positionsOld=[8], positions =\n[\n[0,0,0],"
         "[1,0,0],[0,1,0]]; var subcells=[[9,9,9]]; cells=[[0,1,2]];"),
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        lobe_mesh mesh;
        must_read(texts[i], &mesh);
        assert_int_equal(mesh.vertex_count, 3);
        assert_int_equal(mesh.index_count, 3);
        assert_true(mesh.vertices[1].position[0] == 1 && mesh.vertices[2].position[1] == 1);
        scenes_mesh_free(&mesh);
    }
}

static void broken_modules_are_named(void **state) {
    (void)state;
    must_fail("", "no array 'positions'");
    must_fail("positions = 7", "no array 'positions'");
    must_fail("positions=[[0,0,0]]", "no array 'cells'");
    must_fail("positions=[] cells=[]", "no triangles");
    must_fail("positions=[[0,0,0],[1,0,0],[0,1,0]] cells=[]", "no triangles");
    must_fail("positions=[[0,0,0],[1,0,0],[0,1,0]] cells=[[0,1,3]]", "vertex 3");
    must_fail("positions=[[0,0,0],[1,0,0],[2,0,0]] cells=[[0,1,2]]", "no triangle has an area");
    must_fail("positions=[[0,0,0],\n[1,0,0],\n[0,1]] cells=[[0,1,2]]", "element 2, line 3");
    must_fail("positions=[[0,0,0,0]] cells=[[0,0,0]]", "element 0");
    must_fail("positions=[[0,0,NaN]] cells=[[0,0,0]]", "'positions': element 0");
    must_fail("positions=[[0,0,1e39]] cells=[[0,0,0]]", "'positions': element 0");
    must_fail("positions=[0,0,0] cells=[0,0,0]", "'positions': element 0");
    must_fail("positions=[[0,0,0][1,0,0]] cells=[[0,0,0]]", "'positions'");
    must_fail("positions=[[0,0,0]] cells=[[0,0,-1]]", "'cells': element 0");
    must_fail("positions=[[0,0,0]] cells=[[0,0,0.5]]", "'cells': element 0");
    must_fail("positions=[[0,0,0]] cells=[[0,0,4294967296]]", "'cells': element 0");
    must_fail("positions=[[0,0,0],", "ends within 'positions'");
}

// Whatever the bytes, the result is a mesh or one message.
static void mutations_do_no_harm(void **state) {
    (void)state;
    random_sequence sequence = scenes_random_start(11);
    char text[sizeof tetrahedron];
    for (int i = 0; i < 20000; i++) {
        size_t size = sizeof tetrahedron - 1;
        memcpy(text, tetrahedron, size);
        for (uint32_t changes = scenes_random_bits(&sequence) % 4; changes > 0; changes--)
            text[scenes_random_bits(&sequence) % size] =
                "0123456789.,-+e[]=: \nxyz\0\xff"[scenes_random_bits(&sequence) % 26];
        if (scenes_random_bits(&sequence) % 2)
            size = scenes_random_bits(&sequence) % (size + 1);
        log_recorder recorder;
        log_recorder_start(&recorder);
        lobe_mesh mesh;
        lobe_result result = javascript_mesh_read(text, size, "m.js", &recorder.host, &mesh);
        assert_int_equal(recorder.errors, result != LOBE_OK);
        assert_true((result == LOBE_OK) == (mesh.vertices != NULL));
        scenes_mesh_free(&mesh);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_module_is_read),
        cmocka_unit_test(other_ways_to_write_it_are_read),
        cmocka_unit_test(broken_modules_are_named),
        cmocka_unit_test(mutations_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
