#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "tools/cli/closest_name.h"

static const char *const names[] = {
    "samples", "size", "exposure", "environment", "environment-rotation", "frames", "set"};

static closest_name closest_to(const char *name, size_t length) {
    closest_name closest = {.name = name, .length = length};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        closest_name_offer(&closest, names[i]);
    return closest;
}

static void assert_closest(const char *name, const char *expected) {
    const closest_name closest = closest_to(name, strlen(name));
    if (!expected)
        assert_null(closest.closest);
    else
        assert_string_equal(closest.closest ? closest.closest : "none", expected);
}

static void a_slip_of_the_finger_is_recognised(void **state) {
    (void)state;
    assert_closest("smaples", "samples");  // swapped
    assert_closest("sample", "samples");   // missing
    assert_closest("ssamples", "samples"); // doubled
    assert_closest("sanples", "samples");  // another one
    assert_closest("enviroment", "environment");
    assert_closest("expusore", "exposure"); // two
    assert_closest("sise", "size");
    assert_closest("sez", "set");
    assert_closest("size", "size"); // right
    assert_int_equal(closest_to("size", 4).edits, 0);
}

static void the_beginning_of_a_name_is_enough(void **state) {
    (void)state;
    assert_closest("env", "environment");
    assert_closest("environment-", "environment");
    assert_closest("environment-r", "environment-rotation");
    assert_closest("ex", NULL);
}

static void other_words_are_not(void **state) {
    (void)state;
    assert_closest("", NULL);
    assert_closest("x", NULL);
    assert_closest("colour", NULL);
    assert_closest("paint", NULL);
    assert_closest("a-name-of-fifty-letters-that-no-table-could-contain", NULL);
}

static void only_the_name_itself_counts(void **state) {
    (void)state;
    const closest_name closest = closest_to("smaples=4", 7);
    assert_string_equal(closest.closest, "samples");
    assert_int_equal(closest.edits, 1);
}

static void the_hint_names_it(void **state) {
    (void)state;
    char hint[CLOSEST_NAME_HINT_SIZE];
    closest_name closest = closest_to("smaples", 7);
    assert_string_equal(closest_name_hint(&closest, "--", hint), "; did you mean '--samples'?");
    closest = closest_to("paint", 5);
    assert_string_equal(closest_name_hint(&closest, "--", hint), "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slip_of_the_finger_is_recognised),
        cmocka_unit_test(the_beginning_of_a_name_is_enough),
        cmocka_unit_test(other_words_are_not),
        cmocka_unit_test(only_the_name_itself_counts),
        cmocka_unit_test(the_hint_names_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
