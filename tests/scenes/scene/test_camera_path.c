#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include <lobe/scene.h>

#include "scenes/mesh/vector.h"

enum { STEPS = 4000 };

static const lobe_camera still = {.eye = {1.5f, 2, -0.25f},
                                  .target = {0.5f, 0.75f, 1},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = 0.7f,
                                  .near_plane = 0.05f};

static lobe_camera at(const lobe_camera *camera, double part) {
    lobe_scene scene = {.camera = *camera};
    lobe_camera found;
    lobe_scene_path(&scene, part, &found);
    return found;
}

static vector3 reach(const lobe_camera *camera) {
    return vector3_subtract(vector3_load(camera->eye), vector3_load(camera->target));
}

static void assert_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.9g is not %.9g", value, expected);
}

static void assert_same_direction(vector3 a, vector3 b) {
    vector3_normalise(&a, 0);
    vector3_normalise(&b, 0);
    assert_near(vector3_length(vector3_subtract(a, b)), 0, 1e-6);
}

static void it_starts_at_the_still_camera(void **state) {
    (void)state;
    const double starts[] = {0, -1, NAN, -INFINITY};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        lobe_camera camera = at(&still, starts[i]);
        assert_memory_equal(&camera, &still, sizeof still);
    }
}

static void it_zooms_out_by_64_and_comes_back_to_8(void **state) {
    (void)state;
    const struct {
        double part, distance;
    } known[] = {{0.125, 2.8284271247461903},
                 {0.25, 8},
                 {0.5, 64},
                 {0.625, 22.627416997969522},
                 {0.75, 8},
                 {0.9, 8},
                 {1, 8},
                 {7, 8}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        lobe_camera camera = at(&still, known[i].part);
        double distance = vector3_length(reach(&camera)) / vector3_length(reach(&still));
        assert_near(distance / known[i].distance, 1, 1e-6);
        assert_near(camera.near_plane / (0.05 * known[i].distance), 1, 1e-6);
        assert_true(camera.vertical_field_of_view == still.vertical_field_of_view);
    }
}

static void the_distance_grows_then_shrinks_then_stays(void **state) {
    (void)state;
    double before = vector3_length(reach(&still));
    for (int i = 1; i <= STEPS; i++) {
        double part = (double)i / STEPS;
        lobe_camera camera = at(&still, part);
        double ratio = vector3_length(reach(&camera)) / before;
        // 4096 ^ (1 / STEPS) each way.
        double pace = part <= 0.5 ? 1 : part <= 0.75 ? -1 : 0;
        assert_near(ratio, pow(4096, pace / STEPS), 1e-6);
        before *= ratio;
    }
}

static void it_moves_in_small_steps(void **state) {
    (void)state;
    lobe_camera before = still;
    for (int i = 1; i <= STEPS; i++) {
        lobe_camera camera = at(&still, (double)i / STEPS);
        vector3 step = vector3_subtract(reach(&camera), reach(&before));
        // Its own growth, and at most 4 pi / STEPS of the radius.
        assert_true(vector3_length(step) < vector3_length(reach(&before)) * (12.6 + 8.4) / STEPS);
        assert_memory_equal(camera.target, still.target, sizeof still.target);
        before = camera;
    }
}

static void it_zooms_straight_and_turns_once_about_the_vertical(void **state) {
    (void)state;
    lobe_camera camera;
    for (int i = 0; i <= 8; i++) {
        camera = at(&still, i / 16.0);
        assert_same_direction(reach(&camera), reach(&still));
    }
    vector3 start = reach(&still);
    // Counter-clockwise from above: +Z turns towards +X.
    camera = at(&still, 0.625);
    assert_same_direction(reach(&camera), (vector3){start.z, start.y, -start.x});
    camera = at(&still, 0.75);
    assert_same_direction(reach(&camera), (vector3){-start.x, start.y, -start.z});
    camera = at(&still, 0.875);
    assert_same_direction(reach(&camera), (vector3){-start.z, start.y, start.x});
    camera = at(&still, 1);
    assert_same_direction(reach(&camera), start);
}

static void the_up_vector_stays_upright_and_a_tilted_one_turns_along(void **state) {
    (void)state;
    lobe_camera tilted = still;
    vector3 up = {0.3, 0.9, -0.2};
    vector3_store(up, tilted.up);
    for (int i = 0; i <= 32; i++) {
        lobe_camera camera = at(&still, i / 32.0);
        assert_true(camera.up[0] == 0 && camera.up[1] == 1 && camera.up[2] == 0);
        camera = at(&tilted, i / 32.0);
        assert_near(camera.up[1], tilted.up[1], 0);
        // The angle to the line of sight is constant.
        vector3 sight = reach(&camera), first = reach(&tilted);
        double angle = vector3_dot(vector3_load(camera.up), sight) / vector3_length(sight);
        assert_near(angle, vector3_dot(up, first) / vector3_length(first), 1e-6);
    }
}

static void an_orthographic_camera_sees_more(void **state) {
    (void)state;
    lobe_camera camera = still;
    camera.vertical_field_of_view = 0;
    camera.orthographic_height = 1.25f;
    lobe_camera far = at(&camera, 0.5), end = at(&camera, 1);
    assert_near(far.orthographic_height, 80, 1e-4);
    assert_near(end.orthographic_height, 10, 1e-5);
    assert_true(far.vertical_field_of_view == 0);
    assert_near(vector3_length(reach(&far)), 64 * vector3_length(reach(&still)), 1e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_starts_at_the_still_camera),
        cmocka_unit_test(it_zooms_out_by_64_and_comes_back_to_8),
        cmocka_unit_test(the_distance_grows_then_shrinks_then_stays),
        cmocka_unit_test(it_moves_in_small_steps),
        cmocka_unit_test(it_zooms_straight_and_turns_once_about_the_vertical),
        cmocka_unit_test(the_up_vector_stays_upright_and_a_tilted_one_turns_along),
        cmocka_unit_test(an_orthographic_camera_sees_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
