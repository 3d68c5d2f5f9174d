#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "scenes/format/text_cursor.h"

static text_cursor over(const char *text) {
    return (text_cursor){text, text + strlen(text)};
}

static void numbers_are_those_of_the_standard_library(void **state) {
    (void)state;
    static const char *const texts[] = {
        "0",
        "-0",
        "1",
        "+2.5",
        ".5",
        "7.",
        "1e3",
        "1E+3",
        "25e-4",
        "0.000001",
        "1e-60",
        "3.402823e38",
        "1e-400",
        "123456789012345678901234",
        " \t\n8",
        "1e00002",
        "0.0000000000000000000000000000000000000000000000000000000000001e62"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        text_cursor cursor = over(texts[i]);
        double value;
        assert_true(scenes_text_cursor_number(&cursor, &value));
        assert_true((float)value == strtof(texts[i], NULL));
        assert_true(signbit(value) == signbit(strtod(texts[i], NULL)));
        assert_ptr_equal(cursor.at, cursor.end);
    }
}

static void printed_numbers_come_back(void **state) {
    (void)state;
    random_sequence sequence = scenes_random_start(5);
    for (int i = 0; i < 20000; i++) {
        char text[64];
        double expected = ldexp(scenes_random_between(&sequence, -1, 1),
                                (int)(scenes_random_bits(&sequence) % 200) - 100);
        snprintf(text, sizeof text, i % 2 ? "%.9g" : "%.25e", (double)(float)expected);
        text_cursor cursor = over(text);
        double value;
        assert_true(scenes_text_cursor_number(&cursor, &value));
        assert_true((float)value == (float)expected);
    }
}

static void what_is_no_number_is_left_alone(void **state) {
    (void)state;
    static const char *const texts[] = {"",    " ",    "-",     ".",      "e5",    "1e",
                                        "1e+", "nan",  "inf",   "0x10",   "1.2.3", "12abc",
                                        "--1", "1e39", "1e999", "3.5e38", "1_000"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        text_cursor cursor = over(texts[i]);
        double value;
        assert_false(scenes_text_cursor_number(&cursor, &value));
        assert_ptr_equal(cursor.at, texts[i]);
    }
    // Nothing is read past the end.
    const char *const text = "12345";
    text_cursor cursor = {text, text};
    double value;
    assert_false(scenes_text_cursor_number(&cursor, &value));
}

static void whole_numbers_have_a_limit(void **state) {
    (void)state;
    size_t value = 99;
    text_cursor cursor = over(" 0,17 4294967295");
    assert_true(scenes_text_cursor_integer(&cursor, 17, &value) && value == 0);
    assert_true(scenes_text_cursor_take(&cursor, ',') && !scenes_text_cursor_take(&cursor, ','));
    assert_false(scenes_text_cursor_integer(&cursor, 16, &value));
    assert_true(scenes_text_cursor_integer(&cursor, 17, &value) && value == 17);
    assert_true(scenes_text_cursor_integer(&cursor, 4294967295u, &value) && value == 4294967295u);
    static const char *const wrong[] = {"",    "-1", "+1",     "1.5",
                                        "1e3", "x",  "7seven", "99999999999999999999999"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        cursor = over(wrong[i]);
        assert_false(scenes_text_cursor_integer(&cursor, (size_t)-1, &value));
        assert_ptr_equal(cursor.at, wrong[i]);
    }
}

static void lines_are_counted(void **state) {
    (void)state;
    const char *text = "a\nb\n\nc";
    text_cursor cursor = over(text);
    assert_int_equal(scenes_text_cursor_line(&cursor, text), 1);
    cursor.at = cursor.end;
    assert_int_equal(scenes_text_cursor_line(&cursor, text), 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_those_of_the_standard_library),
        cmocka_unit_test(printed_numbers_come_back),
        cmocka_unit_test(what_is_no_number_is_left_alone),
        cmocka_unit_test(whole_numbers_have_a_limit),
        cmocka_unit_test(lines_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
