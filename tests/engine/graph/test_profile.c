#include "tests/engine/support/cmocka_all.h"

#include <lobe/profile.h>

static lobe_profile *profile;

static int create(void **state) {
    (void)state;
    return lobe_profile_create(NULL, &profile) != LOBE_OK;
}

static int destroy(void **state) {
    (void)state;
    lobe_profile_destroy(&profile);
    lobe_profile_destroy(&profile);
    return profile != NULL;
}

static void add(const lobe_pass_report *passes, size_t count, double milliseconds) {
    const lobe_graph_report report = {.host_milliseconds = 0.75 * milliseconds,
                                      .passes = passes,
                                      .pass_count = count,
                                      .milliseconds = milliseconds};
    assert_int_equal(lobe_profile_add(profile, &report), LOBE_OK);
}

static void no_frame_no_statistics(void **state) {
    (void)state;
    lobe_profile_summary summary;
    assert_int_equal(lobe_profile_statistics(profile, &summary), LOBE_OK);
    assert_int_equal(summary.frame.runs, 0);
    assert_true(summary.frame.median_milliseconds == 0.0);
    assert_int_equal(summary.host.runs, 0);
    assert_int_equal(summary.pass_count, 0);
}

static void median_and_percentile_of_a_known_series(void **state) {
    (void)state;
    lobe_profile_summary summary;
    // 1 to 100, shuffled: the powers of 2 modulo 101.
    for (int i = 0, value = 1; i < 100; i++, value = value * 2 % 101)
        add(&(lobe_pass_report){.name = "a", .milliseconds = value}, 1, 2 * value);
    assert_int_equal(lobe_profile_statistics(profile, &summary), LOBE_OK);
    assert_int_equal(summary.frame.runs, 100);
    assert_int_equal(summary.pass_count, 1);
    assert_string_equal(summary.passes[0].name, "a");
    assert_true(summary.passes[0].median_milliseconds == 50.5);
    assert_true(summary.passes[0].p95_milliseconds == 95.0);
    assert_float_equal(summary.passes[0].share, 0.5, 1e-12);
    assert_true(summary.frame.median_milliseconds == 101.0);
    assert_true(summary.frame.p95_milliseconds == 190.0);
    assert_float_equal(summary.frame.share, 1.0, 1e-12);
    assert_true(summary.host.median_milliseconds == 0.75 * 101.0);
    assert_true(summary.host.p95_milliseconds == 0.75 * 190.0);
    assert_int_equal(summary.host.runs, 100);
}

static void one_frame_is_its_own_median(void **state) {
    (void)state;
    lobe_profile_summary summary;
    add(&(lobe_pass_report){.name = "a", .milliseconds = 3}, 1, 4);
    assert_int_equal(lobe_profile_statistics(profile, &summary), LOBE_OK);
    assert_true(summary.passes[0].median_milliseconds == 3.0);
    assert_true(summary.passes[0].p95_milliseconds == 3.0);
    assert_float_equal(summary.passes[0].share, 0.75, 1e-12);
}

static void passes_of_one_name_are_summed(void **state) {
    (void)state;
    lobe_profile_summary summary;
    const lobe_pass_report passes[] = {
        {.name = "reduce", .milliseconds = 1},
        {.name = "shade", .milliseconds = 5},
        {.name = "reduce", .milliseconds = 2},
    };
    add(passes, 3, 10);
    assert_int_equal(lobe_profile_statistics(profile, &summary), LOBE_OK);
    assert_int_equal(summary.pass_count, 2);
    assert_string_equal(summary.passes[0].name, "reduce");
    assert_true(summary.passes[0].median_milliseconds == 3.0);
    assert_int_equal(summary.passes[0].runs, 1);
    assert_float_equal(summary.passes[1].share, 0.5, 1e-12);
}

/// Frames in which a pass is skipped, or from before it existed, do not count for its time.
static void a_pass_is_judged_by_the_frames_it_ran_in(void **state) {
    (void)state;
    lobe_profile_summary summary;
    const lobe_pass_report passes[] = {
        {.name = "build", .milliseconds = 30},
        {.name = "shade", .milliseconds = 10},
        {.name = "never", .state = LOBE_PASS_CULLED},
    };
    add(&passes[1], 1, 10);
    add(passes, 3, 40);
    for (int i = 0; i < 18; i++) {
        lobe_pass_report still[] = {passes[0], passes[1]};
        still[0].state = LOBE_PASS_SKIPPED;
        add(still, 2, 10);
    }
    assert_int_equal(lobe_profile_statistics(profile, &summary), LOBE_OK);
    assert_int_equal(summary.pass_count, 2);
    assert_string_equal(summary.passes[1].name, "build");
    assert_int_equal(summary.passes[1].runs, 1);
    assert_true(summary.passes[1].median_milliseconds == 30.0);
    assert_true(summary.passes[1].p95_milliseconds == 30.0);
    assert_float_equal(summary.passes[1].share, 30.0 / 230.0, 1e-12);
    assert_true(summary.passes[0].median_milliseconds == 10.0);
    assert_int_equal(summary.passes[0].runs, 20);
    assert_int_equal(summary.frame.runs, 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(no_frame_no_statistics, create, destroy),
        cmocka_unit_test_setup_teardown(median_and_percentile_of_a_known_series, create, destroy),
        cmocka_unit_test_setup_teardown(one_frame_is_its_own_median, create, destroy),
        cmocka_unit_test_setup_teardown(passes_of_one_name_are_summed, create, destroy),
        cmocka_unit_test_setup_teardown(a_pass_is_judged_by_the_frames_it_ran_in, create, destroy),
    };
    return cmocka_run_group_tests_name("profile", tests, NULL, NULL);
}
