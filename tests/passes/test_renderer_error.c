// How far each filter is from the mean of many samples, scene by scene, and who is closer.

#include "tests/passes/fixture.h"

#include <stdio.h>

#include "tests/passes/picture.h"

enum { WIDTH = 320, HEIGHT = 180, SAMPLES = 144 };

/// Relative L2 of linear radiance: what was measured when this was written, and a fifth more.
typedef struct error_bounds {
    const char *scene;
    double direct, mipmap, lobes;
    double lobes_to_mipmap, lobes_to_direct; ///< upper bounds of the quotients; 0: none
} error_bounds;

static double measure(fixture *f, const char *filter, const lobe_image *truth) {
    picture_request request = {
        .filter = filter, .settings = {NULL}, .width = WIDTH, .height = HEIGHT};
    lobe_frame frame = draw(f, &request);
    double error = relative_l2(&frame.radiance, truth);
    lobe_frame_free(&frame);
    return error;
}

static void check_bound(const char *scene, const char *what, double value, double bound) {
    print_message("# %s, %s: %.4g (at most %.4g)\n", scene, what, value, bound);
    if (!(value <= bound))
        fail_msg("%s, %s: %g is above %g", scene, what, value, bound);
}

static void check_scene(fixture *f, const error_bounds *bounds) {
    lobe_scene *scene;
    assert_int_equal(lobe_scene_open(bounds->scene, NULL, &scene), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture_request request = {.filter = "reference",
                               .settings = {NULL},
                               .width = WIDTH,
                               .height = HEIGHT,
                               .samples = SAMPLES};
    lobe_frame truth = draw(f, &request);
    double direct = measure(f, "direct", &truth.radiance);
    double mipmap = measure(f, "mipmap", &truth.radiance);
    double lobes = measure(f, "lobes", &truth.radiance);
    check_bound(bounds->scene, "direct", direct, bounds->direct);
    check_bound(bounds->scene, "mipmap", mipmap, bounds->mipmap);
    check_bound(bounds->scene, "lobes", lobes, bounds->lobes);
    if (bounds->lobes_to_mipmap > 0)
        check_bound(bounds->scene, "lobes/mipmap", lobes / mipmap, bounds->lobes_to_mipmap);
    if (bounds->lobes_to_direct > 0)
        check_bound(bounds->scene, "lobes/direct", lobes / direct, bounds->lobes_to_direct);
    lobe_frame_free(&truth);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void tablecloth_is_within_bounds(void **state) {
    static const error_bounds bounds = {"tablecloth", 1.05, 0.85, 0.14, 0.3, 0.3};
    check_scene(*state, &bounds);
}

static void bumps_is_within_bounds(void **state) {
    static const error_bounds bounds = {"bumps", 2.5, 5.4, 0.25, 0.5, 0.3};
    check_scene(*state, &bounds);
}

/// One direction with two widths: one lobe has a width in between, which is neither.
static void checkerboard_is_within_bounds(void **state) {
    static const error_bounds bounds = {"checkerboard", 0.85, 0.45, 0.75, 0, 0};
    check_scene(*state, &bounds);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tablecloth_is_within_bounds),
        cmocka_unit_test(bumps_is_within_bounds),
        cmocka_unit_test(checkerboard_is_within_bounds),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
