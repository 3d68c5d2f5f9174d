// The scene "flag": cloth that is posed by morph targets has the normals of its shape, its pole
// stays, and gusts stretch it.

#include "tools/scenes/flag_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <lobe/animation.h>
#include <lobe/deformation.h>

static lobe_scene *open(void) {
    lobe_scene *scene;
    assert_int_equal(flag_scene(NULL, NULL, &scene), LOBE_OK);
    assert_int_equal(scene->mesh_count, 1);
    assert_int_equal(scene->rig->animation_count, 1);
    return scene;
}

/// A vertex in the mesh's pose: position, then normal of any length.
static void posed(const lobe_mesh *mesh, size_t vertex, double result[2][3]) {
    const lobe_deformation *d = mesh->deformation;
    for (int i = 0; i < 3; i++) {
        result[0][i] = (double)mesh->vertices[vertex].position[i];
        result[1][i] = (double)mesh->vertices[vertex].normal[i];
    }
    for (uint32_t k = d->first_deltas[vertex]; k < d->first_deltas[vertex + 1]; k++) {
        for (int i = 0; i < 3; i++) {
            const double weight = (double)d->weights[d->deltas[k].target];
            result[0][i] += weight * (double)d->deltas[k].position[i];
            result[1][i] += weight * (double)d->deltas[k].normal[i];
        }
    }
}

/// Columns of a row.
static size_t columns_of(const lobe_mesh *mesh) {
    size_t count = 1;
    while (mesh->vertices[count].position[0] > mesh->vertices[count - 1].position[0])
        ++count;
    return count;
}

/// Slopes of the posed mesh between neighbours are those of its normals.
static void normals_are_those_of_the_shape(void **state) {
    (void)state;
    lobe_scene *scene = open();
    const lobe_mesh *mesh = &scene->meshes[0];
    const size_t columns = columns_of(mesh);
    for (int frame = 0; frame < 4; frame++) {
        assert_int_equal(lobe_scene_set_pose(scene, &(lobe_pose){.seconds = 0.7 * frame}, NULL),
                         LOBE_OK);
        double steepest = 0;
        for (size_t i = columns + 1; i + columns + 1 < mesh->vertex_count; i++) {
            if (i % columns == 0 || (i + 1) % columns == 0)
                continue;
            double own[2][3], left[2][3], right[2][3], above[2][3], below[2][3];
            posed(mesh, i, own);
            posed(mesh, i - 1, left);
            posed(mesh, i + 1, right);
            posed(mesh, i - columns, above);
            posed(mesh, i + columns, below);
            const double x = (right[0][2] - left[0][2]) / (right[0][0] - left[0][0]),
                         y = (above[0][2] - below[0][2]) / (above[0][1] - below[0][1]);
            assert_float_equal(-own[1][0] / own[1][2], x, 0.01);
            assert_float_equal(-own[1][1] / own[1][2], y, 0.01);
            steepest = fmax(steepest, hypot(x, y));
        }
        assert_true(steepest > 0.3 && steepest < 1.5);
    }
    lobe_scene_destroy(&scene);
}

static void the_pole_holds_it(void **state) {
    (void)state;
    lobe_scene *scene = open();
    const lobe_mesh *mesh = &scene->meshes[0];
    assert_int_equal(lobe_scene_set_pose(scene, &(lobe_pose){.seconds = 1.3}, NULL), LOBE_OK);
    for (size_t i = 0; i < mesh->vertex_count; i += columns_of(mesh)) {
        double own[2][3];
        posed(mesh, i, own);
        assert_float_equal(own[0][0], 0, 0);
        assert_float_equal(own[0][2], 0, 1e-7);
    }
    lobe_scene_destroy(&scene);
}

static void gusts_stretch_it_and_it_repeats(void **state) {
    (void)state;
    static const double strains[] = {1, 1.15, 1.3, 1.15, 1}, weights[] = {1, -1, 1, -1, 1};
    lobe_scene *scene = open();
    assert_float_equal(scene->rig->animations[0].duration, 4, 0);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(lobe_scene_set_pose(scene, &(lobe_pose){.seconds = i}, NULL), LOBE_OK);
        const float *transform = scene->instances[0].transform;
        assert_float_equal(transform[0], strains[i], 1e-5);
        assert_float_equal(transform[5], 1, 1e-6);
        assert_float_equal(scene->meshes[0].deformation->weights[0], weights[i], 1e-5);
        assert_true(scene->maximum[0] > 1.49f * (float)strains[i]);
    }
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_are_those_of_the_shape),
        cmocka_unit_test(the_pole_holds_it),
        cmocka_unit_test(gusts_stretch_it_and_it_repeats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
