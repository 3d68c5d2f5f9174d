// Filters, their knobs, and how they are set.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static fixture messages;

static void record(void *user, lobe_log_level level, const char *message) {
    (void)user;
    if (level != LOBE_LOG_ERROR)
        return;
    messages.errors++;
    snprintf(messages.error, sizeof messages.error, "%s", message);
}

static const lobe_host log_to_messages = {.write = record};

static int forget(void **state) {
    (void)state;
    fixture_forget_messages(&messages);
    return 0;
}

static void filters_are_found_by_name(void **state) {
    (void)state;
    static const char *const names[] = {"direct", "mipmap", "lobes", "reference"};
    assert_true(lobe_filter_count() >= sizeof names / sizeof *names);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const lobe_filter *filter;
        assert_int_equal(lobe_filter_find(names[i], &log_to_messages, &filter), LOBE_OK);
        assert_string_equal(lobe_filter_name(filter), names[i]);
        assert_int_equal(lobe_filter_supersamples(filter), strcmp(names[i], "reference") == 0);
    }
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        assert_true(strlen(lobe_filter_summary(filter)) > 0);
        assert_non_null(lobe_filter_paper(filter));
    }
    assert_null(lobe_filter_get(lobe_filter_count()));
    assert_int_equal(messages.errors, 0);
}

static void an_unknown_filter_lists_those_there_are(void **state) {
    (void)state;
    const lobe_filter *filter = lobe_filter_get(0);
    lobe_result result = lobe_filter_find("lobe", &log_to_messages, &filter);
    assert_failure(&messages, result, LOBE_ERROR_NOT_FOUND, "'lobe'");
    for (size_t i = 0; i < lobe_filter_count(); i++)
        assert_non_null(strstr(messages.error, lobe_filter_name(lobe_filter_get(i))));
    assert_null(filter);
    assert_int_equal(lobe_filter_find("", NULL, &filter), LOBE_ERROR_NOT_FOUND);
}

/// The parts of a knob that the command line, the benchmark and the documentation use.
static void knobs_describe_themselves(void **state) {
    (void)state;
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        size_t count = lobe_filter_knob_count(filter);
        assert_in_range(count, 1, LOBE_MAXIMUM_KNOBS);
        for (size_t j = 0; j < count; j++) {
            const lobe_knob *knob = lobe_filter_knob(filter, j);
            assert_true(strlen(knob->name) > 0 && strlen(knob->summary) > 0);
            assert_true(knob->minimum < knob->maximum);
            assert_true(knob->initial >= knob->minimum && knob->initial <= knob->maximum);
            assert_int_equal(knob->choices != NULL, knob->kind == LOBE_KNOB_CHOICE);
            size_t choices = 0;
            while (knob->choices && knob->choices[choices])
                choices++;
            if (knob->choices)
                assert_true(knob->minimum == 0 && knob->maximum == (double)choices - 1);
            for (size_t k = 0; k < j; k++)
                assert_string_not_equal(lobe_filter_knob(filter, k)->name, knob->name);
        }
        assert_null(lobe_filter_knob(filter, count));
    }
}

/// The value of a knob that the filter has.
static double value_of(const lobe_filter *filter, const lobe_settings *settings, const char *name) {
    double value = NAN;
    assert_int_equal(lobe_settings_get(filter, settings, name, &value, &log_to_messages), LOBE_OK);
    return value;
}

/// Both ends of every range and every choice can be set and read back, and print as they were
/// written.
static void every_value_goes_in_and_comes_out(void **state) {
    (void)state;
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        for (size_t j = 0; j < lobe_filter_knob_count(filter); j++) {
            const lobe_knob *knob = lobe_filter_knob(filter, j);
            double values[2] = {knob->minimum, knob->maximum};
            for (int k = 0; k < 2; k++) {
                char value[64], assignment[160], printed[64];
                if (knob->choices)
                    snprintf(value, sizeof value, "%s", knob->choices[(size_t)values[k]]);
                else
                    snprintf(value, sizeof value, "%g", values[k]);
                snprintf(assignment, sizeof assignment, "%s=%s", knob->name, value);
                lobe_settings settings;
                lobe_settings_default(filter, &settings);
                assert_true(value_of(filter, &settings, knob->name) == knob->initial);
                assert_int_equal(lobe_settings_set(filter, &settings, assignment, &log_to_messages),
                                 LOBE_OK);
                assert_true(value_of(filter, &settings, knob->name) == values[k]);
                lobe_settings_print(filter, &settings, j, printed, sizeof printed);
                assert_string_equal(printed, value);
            }
        }
    }
    assert_int_equal(messages.errors, 0);
}

/// A rejected assignment: the code, words of the line, and unchanged settings.
static void check_refusal(const char *filter_name, const char *assignment, lobe_result expected,
                          const char *words) {
    const lobe_filter *filter;
    assert_int_equal(lobe_filter_find(filter_name, NULL, &filter), LOBE_OK);
    lobe_settings settings, before;
    lobe_settings_default(filter, &settings);
    before = settings;
    fixture_forget_messages(&messages);
    lobe_result result = lobe_settings_set(filter, &settings, assignment, &log_to_messages);
    assert_failure(&messages, result, expected, words);
    assert_memory_equal(&settings, &before, sizeof settings);
    // The same without a log, silently.
    assert_int_equal(lobe_settings_set(filter, &settings, assignment, NULL), expected);
}

static void bad_assignments_are_refused(void **state) {
    (void)state;
    check_refusal("lobes", "epsilon=1", LOBE_ERROR_NOT_FOUND, "epsilon0, epsilon1");
    check_refusal("direct", "epsilon0=1", LOBE_ERROR_NOT_FOUND, "view");
    check_refusal("lobes", "=1", LOBE_ERROR_NOT_FOUND, "no knob ''");
    check_refusal("lobes", "epsilon0", LOBE_ERROR_INVALID_ARGUMENT, "NAME=VALUE");
    check_refusal("lobes", "", LOBE_ERROR_INVALID_ARGUMENT, "NAME=VALUE");
    check_refusal("lobes", "epsilon0=", LOBE_ERROR_INVALID_ARGUMENT, "from 0 to 1");
    check_refusal("lobes", "epsilon0=1.5", LOBE_ERROR_INVALID_ARGUMENT, "from 0 to 1");
    check_refusal("lobes", "epsilon0=-0.1", LOBE_ERROR_INVALID_ARGUMENT, "from 0 to 1");
    check_refusal("lobes", "epsilon0=nan", LOBE_ERROR_INVALID_ARGUMENT, "from 0 to 1");
    check_refusal("lobes", "epsilon0=inf", LOBE_ERROR_INVALID_ARGUMENT, "from 0 to 1");
    check_refusal("lobes", "epsilon0=0.5x", LOBE_ERROR_INVALID_ARGUMENT, "from 0 to 1");
    check_refusal("lobes", "probes=1.5", LOBE_ERROR_INVALID_ARGUMENT, "whole number");
    check_refusal("lobes", "subdivision=3", LOBE_ERROR_INVALID_ARGUMENT, "auto, 0, 1, 2");
    check_refusal("lobes", "space=world", LOBE_ERROR_INVALID_ARGUMENT,
                  "auto, tangent, object, camera");
    check_refusal("lobes", "space=", LOBE_ERROR_INVALID_ARGUMENT, "auto");
    check_refusal("mipmap", "probes=0", LOBE_ERROR_INVALID_ARGUMENT, "from 1 to 16");
}

static void a_missing_knob_has_no_value(void **state) {
    (void)state;
    const lobe_filter *filter;
    assert_int_equal(lobe_filter_find("direct", NULL, &filter), LOBE_OK);
    lobe_settings settings;
    lobe_settings_default(filter, &settings);
    static const char *const names[] = {"epsilon0", "view ", "vie", ""};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        double value = -7;
        fixture_forget_messages(&messages);
        lobe_result result =
            lobe_settings_get(filter, &settings, names[i], &value, &log_to_messages);
        assert_failure(&messages, result, LOBE_ERROR_NOT_FOUND,
                       "curvature, normal_mapping, view, samples, shading, base");
        assert_true(value == -7);
        assert_int_equal(lobe_settings_get(filter, &settings, names[i], &value, NULL),
                         LOBE_ERROR_NOT_FOUND);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(filters_are_found_by_name, forget),
        cmocka_unit_test_setup(an_unknown_filter_lists_those_there_are, forget),
        cmocka_unit_test_setup(knobs_describe_themselves, forget),
        cmocka_unit_test_setup(every_value_goes_in_and_comes_out, forget),
        cmocka_unit_test_setup(bad_assignments_are_refused, forget),
        cmocka_unit_test_setup(a_missing_knob_has_no_value, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
