// How far each filter is from the mean of many samples, scene by scene, and which filter is closer.
// The validation layer, with synchronisation validation, is silent meanwhile.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"

enum { WIDTH = 160, HEIGHT = 90, MOST_FILTERS = 16 };

/// Largest relative L2 error of linear radiance: measured when this was written, plus 15 %.
typedef struct error_bound {
    const char *filter;
    double most;
} error_bound;

/// One filter's error is at most this many times the other's.
typedef struct error_order {
    const char *better, *worse;
    double most;
} error_order;

typedef struct error_bounds {
    const char *scene;
    uint32_t samples;                 ///< of the reference
    error_bound bounds[MOST_FILTERS]; ///< ended by NULL; every filter but the reference
    error_order orders[MOST_FILTERS]; ///< ended by NULL
} error_bounds;

static double measure(fixture *f, const char *scene, const char *filter, bool outputs,
                      const lobe_image *truth) {
    picture_request request = {
        .filter = filter, .settings = {NULL}, .width = WIDTH, .height = HEIGHT, .outputs = outputs};
    lobe_frame frame = draw_silently(f, scene, &request);
    double error = relative_l2(&frame.radiance, truth);
    lobe_frame_free(&frame);
    return error;
}

/// The error of a filter, by name.
static double error_of(const error_bounds *bounds, const double errors[], const char *filter) {
    for (int i = 0; bounds->bounds[i].filter; i++) {
        if (strcmp(bounds->bounds[i].filter, filter) == 0)
            return errors[i];
    }
    fail_msg("%s, %s: no bound", bounds->scene, filter);
    return NAN;
}

/// Checks all bounds before failing.
static void check_errors(const error_bounds *bounds, const double errors[]) {
    unsigned failures = 0;
    for (int i = 0; bounds->bounds[i].filter; i++) {
        const error_bound *bound = &bounds->bounds[i];
        bool kept = errors[i] <= bound->most;
        print_message("# %s, %s: %.4g (at most %.4g)%s\n", bounds->scene, bound->filter, errors[i],
                      bound->most, kept ? "" : " FAILED");
        failures += !kept;
    }
    for (int i = 0; bounds->orders[i].better; i++) {
        const error_order *order = &bounds->orders[i];
        double ratio =
            error_of(bounds, errors, order->better) / error_of(bounds, errors, order->worse);
        bool kept = ratio <= order->most;
        print_message("# %s, %s/%s: %.4g (at most %.4g)%s\n", bounds->scene, order->better,
                      order->worse, ratio, order->most, kept ? "" : " FAILED");
        failures += !kept;
    }
    if (failures)
        fail_msg("%s: %u bounds were not kept", bounds->scene, failures);
}

static bool has_bound(const error_bounds *bounds, const char *filter) {
    for (int i = 0; bounds->bounds[i].filter; i++) {
        if (strcmp(bounds->bounds[i].filter, filter) == 0)
            return true;
    }
    return false;
}

static size_t scene_number(const char *name) {
    size_t i = 0;
    while (strcmp(lobe_builtin_scene_get(i)->name, name) != 0)
        i++;
    return i;
}

/// Mixtures are fitted for seconds to some scenes' maps, the peaks of `fournier` to all of them. No
/// scene has a relief.
static bool is_measured(const char *scene, const char *filter) {
    const bool large = strcmp(scene, "hall") == 0 || strcmp(scene, "tablecloth") == 0;
    const bool mixture = strcmp(filter, "mixture") == 0 || strcmp(filter, "tan") == 0 ||
                         strcmp(filter, "multi_leadr") == 0;
    const bool relief =
        strncmp(filter, "displaced", strlen("displaced")) == 0 || strcmp(filter, "wu") == 0;
    return strcmp(filter, "reference") != 0 && strcmp(filter, "fournier") != 0 && !relief &&
           !(large && mixture);
}

static void check_table(const error_bounds *bounds) {
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const char *filter = lobe_filter_name(lobe_filter_get(i));
        if (is_measured(bounds->scene, filter) && !has_bound(bounds, filter))
            fail_msg("%s, %s: no bound", bounds->scene, filter);
    }
}

/// Each filter writes outputs in every other scene, as in the test of determinism: the driver finds
/// those shaders in its cache.
static void check_scene(fixture *f, const error_bounds *bounds) {
    lobe_scene *scene;
    double errors[MOST_FILTERS];
    const size_t number = scene_number(bounds->scene);
    check_table(bounds);
    assert_int_equal(lobe_scene_open(bounds->scene, NULL, &scene), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture_request request = {.filter = "reference",
                               .settings = {NULL},
                               .width = WIDTH,
                               .height = HEIGHT,
                               .samples = bounds->samples};
    lobe_frame truth = draw_silently(f, bounds->scene, &request);
    for (size_t i = 0; bounds->bounds[i].filter; i++)
        errors[i] =
            measure(f, bounds->scene, bounds->bounds[i].filter, (number + i) % 2, &truth.radiance);
    lobe_frame_free(&truth);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    check_errors(bounds, errors);
}

static void tablecloth_is_within_bounds(void **state) {
    static const error_bounds bounds = {"tablecloth",
                                        144,
                                        {{"direct", 1.06},
                                         {"mipmap", 0.83},
                                         {"toksvig", 0.2},
                                         {"lean", 0.36},
                                         {"leadr", 0.365},
                                         {"lobes", 0.134},
                                         {"moments", 0.103}},
                                        {{"lobes", "mipmap", 0.3},
                                         {"lobes", "direct", 0.3},
                                         {"toksvig", "mipmap", 0.5},
                                         {"moments", "lobes", 0.9},
                                         {"moments", "lean", 0.5}}};
    check_scene(*state, &bounds);
}

/// `tan` divides by the cosine to the viewer, without masking.
static void bumps_is_within_bounds(void **state) {
    static const error_bounds bounds = {"bumps",
                                        144,
                                        {{"direct", 2.3},
                                         {"mipmap", 5.1},
                                         {"toksvig", 0.376},
                                         {"lean", 0.456},
                                         {"leadr", 0.42},
                                         {"multi_leadr", 0.25},
                                         {"lobes", 0.21},
                                         {"moments", 0.2},
                                         {"tan", 8.8},
                                         {"mixture", 0.2}},
                                        {{"lobes", "mipmap", 0.3},
                                         {"lobes", "direct", 0.3},
                                         {"toksvig", "mipmap", 0.3},
                                         {"moments", "lobes", 1.1},
                                         {"moments", "lean", 0.7},
                                         {"mixture", "moments", 1.1}}};
    check_scene(*state, &bounds);
}

/// One direction with two widths: a single lobe has a width in between, which is neither; bins, and
/// clusters of two widths, keep them apart.
static void checkerboard_is_within_bounds(void **state) {
    static const error_bounds bounds = {
        "checkerboard",
        144,
        {{"direct", 0.83},
         {"mipmap", 0.42},
         {"toksvig", 0.42},
         {"lean", 0.74},
         {"leadr", 0.74},
         {"multi_leadr", 0.045},
         {"lobes", 0.048},
         {"moments", 0.048},
         {"tan", 0.051},
         {"mixture", 0.051}},
        {{"lobes", "lean", 0.2}, {"moments", "lean", 0.2}, {"moments", "mipmap", 0.2}}};
    check_scene(*state, &bounds);
}

/// Widths again, of silk and gold, in threads of different roundness.
static void pillow_is_within_bounds(void **state) {
    only_in_long_runs();
    static const error_bounds bounds = {
        "pillow",
        64,
        {{"direct", 0.56},
         {"mipmap", 0.25},
         {"toksvig", 0.254},
         {"lean", 0.33},
         {"leadr", 0.331},
         {"multi_leadr", 0.097},
         {"lobes", 0.145},
         {"moments", 0.122},
         {"tan", 0.122},
         {"mixture", 0.108}},
        {{"moments", "lobes", 0.97}, {"moments", "lean", 0.45}, {"moments", "mipmap", 0.6}}};
    check_scene(*state, &bounds);
}

static void hall_is_within_bounds(void **state) {
    only_in_long_runs();
    static const error_bounds bounds = {"hall",
                                        64,
                                        {{"direct", 1.21},
                                         {"mipmap", 0.63},
                                         {"toksvig", 0.5},
                                         {"lean", 0.56},
                                         {"leadr", 0.705},
                                         {"lobes", 0.41},
                                         {"moments", 0.37}},
                                        {{"lobes", "mipmap", 0.95},
                                         {"toksvig", "mipmap", 0.95},
                                         {"moments", "lobes", 1.05},
                                         {"moments", "lean", 0.8}}};
    check_scene(*state, &bounds);
}

static void every_scene_is_measured(void **state) {
    (void)state;
    assert_int_equal(lobe_builtin_scene_count(), 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scene_is_measured), cmocka_unit_test(tablecloth_is_within_bounds),
        cmocka_unit_test(bumps_is_within_bounds),  cmocka_unit_test(checkerboard_is_within_bounds),
        cmocka_unit_test(pillow_is_within_bounds), cmocka_unit_test(hall_is_within_bounds),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
