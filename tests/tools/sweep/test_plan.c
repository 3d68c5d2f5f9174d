#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "passes/context/filter.h"
#include "tests/engine/support/log_recorder.h"
#include "tools/sweep/sweep.h"

static const char *const shapes[] = {"round", "square", NULL};

static const filter_knob count_knob = {.description = {.name = "count",
                                                       .kind = LOBE_KNOB_INTEGER,
                                                       .minimum = 1,
                                                       .maximum = 8,
                                                       .initial = 2,
                                                       .sweep = "1,2,4"}};
static const filter_knob shape_knob = {.description = {.name = "shape",
                                                       .kind = LOBE_KNOB_CHOICE,
                                                       .maximum = 1,
                                                       .choices = shapes,
                                                       .sweep = "round,square"}};
static const filter_knob still_knob = {.description = {.name = "still", .maximum = 1}};
static const filter_knob wrong_knob = {
    .description = {.name = "wrong", .maximum = 1, .sweep = "0.5,2"}};

static const filter_knob bright_knob = {.description = {.name = "bright",
                                                        .kind = LOBE_KNOB_INTEGER,
                                                        .maximum = 9,
                                                        .sweep = "0,7",
                                                        .sweep_with = "shape=square",
                                                        .environment = true}};

static const filter_knob *const good_knobs[] = {&count_knob, &still_knob, &shape_knob, &bright_knob,
                                                NULL};
static const filter_knob *const bad_knobs[] = {&count_knob, &wrong_knob, NULL};
static const lobe_filter good = {.name = "good", .knobs = good_knobs};
static const lobe_filter bad = {.name = "bad", .knobs = bad_knobs};
static const lobe_filter sampling = {.name = "sampling", .knobs = good_knobs, .supersamples = true};

static bench_filter with_defaults(const lobe_filter *filter) {
    bench_filter result = {.filter = filter};
    lobe_settings_default(filter, &result.settings);
    return result;
}

static void assert_variant(const sweep_variant *variant, const char *varied, const char *value) {
    sweep_setting settings[LOBE_MAXIMUM_KNOBS];
    const size_t count = sweep_variant_settings(variant, settings);
    assert_string_equal(variant->varied, varied);
    for (size_t i = 0; i < count; i++) {
        const bool is_varied = strcmp(settings[i].name, varied) == 0;
        if (is_varied)
            assert_string_equal(settings[i].value, value);
        else if (strcmp(settings[i].name, "count") == 0)
            assert_string_equal(settings[i].value, "2");
        else if (strcmp(settings[i].name, "shape") == 0)
            assert_string_equal(settings[i].value, "round");
    }
}

static void values_are_varied_one_at_a_time(void **state) {
    (void)state;
    const bench_filter filters[] = {with_defaults(&good)};
    sweep_plan plan;
    assert_int_equal(
        sweep_plan_make(&(sweep_plan_request){.filters = filters, .filter_count = 1}, NULL, &plan),
        LOBE_OK);
    assert_int_equal(plan.count, 4);
    assert_variant(&plan.variants[0], "", NULL);
    assert_variant(&plan.variants[1], "count", "1");
    assert_variant(&plan.variants[2], "count", "4");
    assert_variant(&plan.variants[3], "shape", "square");
    sweep_plan_free(&plan);
    assert_null(plan.variants);
}

static void knobs_of_environments_need_one(void **state) {
    (void)state;
    const bench_filter filters[] = {with_defaults(&good)};
    sweep_plan plan;
    assert_int_equal(
        sweep_plan_make(
            &(sweep_plan_request){.filters = filters, .filter_count = 1, .environment = true}, NULL,
            &plan),
        LOBE_OK);
    size_t bright = 0, methods = 0;
    for (size_t i = 0; i < plan.count; i++) {
        bright += strcmp(plan.variants[i].varied, "bright") == 0;
        methods += strcmp(plan.variants[i].varied, "env") == 0;
    }
    assert_int_equal(bright, 1);
    assert_int_equal(methods, 2);
    sweep_plan_free(&plan);
}

static void only_some_knobs_are_varied(void **state) {
    (void)state;
    const bench_filter filters[] = {with_defaults(&good)};
    sweep_plan plan;
    assert_int_equal(sweep_plan_make(&(sweep_plan_request){.filters = filters,
                                                           .filter_count = 1,
                                                           .environment = true,
                                                           .knobs = "shape,bright"},
                                     NULL, &plan),
                     LOBE_OK);
    assert_int_equal(plan.count, 3);
    assert_variant(&plan.variants[1], "shape", "square");
    // Knobs that it requires are set, too.
    sweep_setting settings[LOBE_MAXIMUM_KNOBS];
    sweep_variant_settings(&plan.variants[2], settings);
    assert_string_equal(plan.variants[2].varied, "bright");
    assert_string_equal(settings[2].value, "square");
    assert_string_equal(settings[3].value, "7");
    sweep_plan_free(&plan);
    assert_int_equal(sweep_plan_make(&(sweep_plan_request){.filters = filters,
                                                           .filter_count = 1,
                                                           .environment = true,
                                                           .knobs = "none"},
                                     NULL, &plan),
                     LOBE_OK);
    assert_int_equal(plan.count, 1);
    sweep_plan_free(&plan);
}

static void a_supersampling_filter_keeps_its_defaults(void **state) {
    (void)state;
    const bench_filter filters[] = {with_defaults(&sampling)};
    sweep_plan plan;
    assert_int_equal(
        sweep_plan_make(&(sweep_plan_request){.filters = filters, .filter_count = 1}, NULL, &plan),
        LOBE_OK);
    assert_int_equal(plan.count, 1);
    assert_variant(&plan.variants[0], "", NULL);
    sweep_plan_free(&plan);
}

static void a_filter_given_twice_is_measured_once(void **state) {
    (void)state;
    const bench_filter filters[] = {with_defaults(&sampling), with_defaults(&good),
                                    with_defaults(&sampling)};
    sweep_plan plan;
    assert_int_equal(
        sweep_plan_make(&(sweep_plan_request){.filters = filters, .filter_count = 3}, NULL, &plan),
        LOBE_OK);
    assert_int_equal(plan.count, 5);
    sweep_plan_free(&plan);
}

static void a_value_out_of_range_is_refused(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    const bench_filter filters[] = {with_defaults(&bad)};
    sweep_plan plan;
    assert_int_equal(sweep_plan_make(&(sweep_plan_request){.filters = filters, .filter_count = 1},
                                     &recorder.host, &plan),
                     LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "wrong"));
    sweep_plan_free(&plan);
}

/// The values that filters list for a sweep must be valid for their own knobs, and not the default.
static void all_filters_have_sound_lists(void **state) {
    (void)state;
    for (size_t i = 0; i < 2 * lobe_filter_count(); i++) {
        const bench_filter filter = with_defaults(lobe_filter_get(i / 2));
        const bool environment = i % 2 == 1;
        size_t values = 1;
        for (size_t k = 0; k < lobe_filter_knob_count(filter.filter); k++) {
            const char *rest = lobe_filter_knob(filter.filter, k)->sweep;
            for (; rest; rest = strchr(rest, ',') ? strchr(rest, ',') + 1 : NULL)
                values++;
        }
        sweep_plan plan;
        assert_int_equal(sweep_plan_make(&(sweep_plan_request){.filters = &filter,
                                                               .filter_count = 1,
                                                               .environment = environment},
                                         NULL, &plan),
                         LOBE_OK);
        assert_true(plan.count <= values);
        assert_int_equal(plan.variants[0].varied[0], 0);
        sweep_plan_free(&plan);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_varied_one_at_a_time),
        cmocka_unit_test(knobs_of_environments_need_one),
        cmocka_unit_test(only_some_knobs_are_varied),
        cmocka_unit_test(a_supersampling_filter_keeps_its_defaults),
        cmocka_unit_test(a_filter_given_twice_is_measured_once),
        cmocka_unit_test(a_value_out_of_range_is_refused),
        cmocka_unit_test(all_filters_have_sound_lists),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
