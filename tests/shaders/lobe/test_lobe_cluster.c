// shaders/lib/lobe/lobe_cluster.glsl: a partition, against its double-precision twin.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/lobe_cluster.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 4000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void test_clusters(void **state) {
    uint64_t random = 17;
    size_t members[8] = {0}, members_of_paper[8] = {0};
    for (size_t i = 0; i < COUNT; i++) {
        static const float pole[3] = {0, 0, 1};
        // Half of them near the pole, where a third or so is within the split.
        if (i % 2)
            random_direction(&random, arguments[i].a);
        else
            direction_at(pole, scenes_random_between(&random, 0, 0.4),
                         scenes_random_between(&random, 0, 7), arguments[i].a);
    }
    harness_evaluate(state, "lobe/lobe_cluster.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a;
        uint32_t cluster = reference_cluster_of((double[]){a[0], a[1], a[2]}, false);
        uint32_t paper = reference_cluster_of((double[]){a[0], a[1], a[2]}, true);
        assert_int_equal(results[i].value[0], cluster);
        assert_int_equal(results[i].value[1], cluster / 2);
        assert_int_equal(results[i].value[2], paper);
        assert_int_equal(results[i].value[3], 4);
        members[cluster]++;
        members_of_paper[paper]++;
    }
    for (int i = 0; i < 8; i++)
        assert_true(members[i] > COUNT / 80 && members_of_paper[i] > COUNT / 80);
}

// Directions along the axes of a texture, turned a little either way, stay together, as the lobes
// of the tablecloth must.
static void test_axes_are_inside(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        double azimuth = (double)(i % 4) * M_PI / 2 + (i / 4 % 2 ? 0.7 : -0.7);
        double tilt = geometric(1e-3, 3, i, COUNT);
        arguments[i].a[0] = (float)(sin(tilt) * cos(azimuth));
        arguments[i].a[1] = (float)(sin(tilt) * sin(azimuth));
        arguments[i].a[2] = (float)cos(tilt);
    }
    harness_evaluate(state, "lobe/lobe_cluster.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        assert_int_equal(results[i].value[1], i % 4);
        // Within 10 degrees near the pole, beyond 15 tilted.
        double tilt = geometric(1e-3, 3, i, COUNT);
        if (tilt < 0.17)
            assert_int_equal(results[i].value[0], 2 * (i % 4));
        if (tilt > 0.26)
            assert_int_equal(results[i].value[0], 2 * (i % 4) + 1);
    }
}

static void test_borders(void **state) {
    static const harness_arguments borders[] = {{{0, 0, 1}, {0}, {0}},
                                                {{-0.0f, -0.0f, 1}, {0}, {0}},
                                                {{0, 0, -1}, {0}, {0}},
                                                {{0.5f, 0.5f, 0.70710677f}, {0}, {0}},
                                                {{-0.5f, 0.5f, 0.70710677f}, {0}, {0}},
                                                {{0.20860016f, 0, 0.978f}, {0}, {0}}};
    static const int expected[] = {0, 0, 1, 1, 5, 0};
    harness_result values[6];
    harness_evaluate(state, "lobe/lobe_cluster.comp", 0, borders, 6, values);
    static const int expected_of_paper[] = {0, 0, 1, 0, 2, 0};
    for (int i = 0; i < 6; i++) {
        assert_int_equal(values[i].value[0], expected[i]);
        assert_int_equal(values[i].value[2], expected_of_paper[i]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_clusters),
        cmocka_unit_test(test_axes_are_inside),
        cmocka_unit_test(test_borders),
    };
    return cmocka_run_group_tests_name("lobe_cluster", tests, harness_set_up, harness_tear_down);
}
