// shaders/lib/map/facing_slope.glsl: slopes that face away move to the one that is drawn, no
// further than they must.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "map/facing_slope.comp";
enum { SLOPE, NORMAL };

enum { COUNT = 3000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT], normals[COUNT];

/// Of what a facet appears, over its area in the plane.
static double height(const float *slope, const float *outgoing) {
    return (double)outgoing[2] - (double)slope[0] * outgoing[0] - (double)slope[1] * outgoing[1];
}

static void make_arguments(void) {
    uint64_t random = 3;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        for (int k = 0; k < 4; k++)
            at->a[k] = (float)scenes_random_between(&random, -2, 2);
        random_direction(&random, at->b);
        at->b[2] = fabsf(at->b[2]);
        const float length = (float)scenes_random_between(&random, 0.3, 1);
        const float scale = length / sqrtf(1 + at->a[0] * at->a[0] + at->a[1] * at->a[1]);
        at->c[0] = -scale * at->a[0];
        at->c[1] = -scale * at->a[1];
        at->c[2] = scale;
    }
}

static void slopes_face_the_viewer(void **state) {
    make_arguments();
    harness_evaluate(state, shader, SLOPE, arguments, COUNT, results);
    harness_evaluate(state, shader, NORMAL, arguments, COUNT, normals);
    size_t moved = 0, kept = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *v = results[i].value, *n = normals[i].value;
        const double drawn = height(at->a + 2, at->b), own = height(at->a, at->b);
        const double least = 0.1 * fmax(drawn, 0), shown = height(v, at->b);
        if (drawn <= 0.01)
            continue; // triangles that are seen face the viewer
        if (own >= least) {
            check_close("kept", at, hypot(v[0] - at->a[0], v[1] - at->a[1]), 0, 1e-6);
            ++kept;
        } else {
            check_close("moved", at, shown, least, 2e-5);
            // Between both: the cross product is zero.
            const double x = at->a[2] - at->a[0], y = at->a[3] - at->a[1];
            check_close("between", at, x * (v[1] - at->a[1]) - y * (v[0] - at->a[0]), 0, 1e-5);
            ++moved;
        }
        const double length = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
        check_close("normal", at, -n[0] / n[2], v[0], 1e-4);
        check_close("normal", at, -n[1] / n[2], v[1], 1e-4);
        check_close("length", at, length,
                    sqrt((double)(at->c[0] * at->c[0] + at->c[1] * at->c[1] + at->c[2] * at->c[2])),
                    1e-6);
    }
    assert_true(moved > COUNT / 10 && kept > COUNT / 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_face_the_viewer),
    };
    return cmocka_run_group_tests_name("facing_slope", tests, harness_set_up, harness_tear_down);
}
