#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "tests/tools/cli/captured_output.h"
#include "tools/cli/options.h"

/// One option of each kind, and the values that the parser left in them.
typedef struct sample {
    bool flag, size_given;
    const char *text;
    uint32_t integer, size[2], choice;
    double number;
    float vector[3];
    option_list list, operands;
    bool went_on;
} sample;

static sample found;

static int parse(int argc, char **argv) {
    static const char *const choices[] = {"red", "green", "blue", NULL};
    const option options[] = {
        {.name = "flag",
         .letter = 'f',
         .kind = OPTION_FLAG,
         .summary = "a flag",
         .target = &found.flag},
        {.name = "text",
         .letter = 'o',
         .kind = OPTION_TEXT,
         .argument = "FILE",
         .summary = "a text",
         .target = &found.text,
         .fallback = "none"},
        {.name = "integer",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "an integer",
         .target = &found.integer,
         .fallback = "7",
         .minimum = 1,
         .maximum = 4096},
        {.name = "number",
         .kind = OPTION_NUMBER,
         .argument = "X",
         .summary = "a number",
         .target = &found.number,
         .fallback = "0.5",
         .minimum = -2,
         .maximum = 2},
        {.name = "size",
         .kind = OPTION_SIZE,
         .argument = "WxH",
         .summary = "a size",
         .target = &found.size,
         .fallback = "1280x720",
         .minimum = 1,
         .maximum = 65535,
         .given = &found.size_given},
        {.name = "vector",
         .kind = OPTION_VECTOR,
         .argument = "X,Y,Z",
         .summary = "a vector",
         .target = &found.vector,
         .fallback = "0,1,0"},
        {.name = "choice",
         .kind = OPTION_CHOICE,
         .argument = "COLOUR",
         .summary = "a colour",
         .target = &found.choice,
         .fallback = "green",
         .choices = choices},
        {.name = "set",
         .kind = OPTION_LIST,
         .argument = "KNOB=VALUE",
         .summary = "a knob",
         .target = &found.list},
    };
    const option_table table = {
        .program = "lobe sample",
        .operands = "FIRST [SECOND]",
        .summary = "Samples.",
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .minimum_operands = 1,
        .maximum_operands = 2,
    };
    int status = -1;
    found = (sample){0};
    found.went_on = options_parse(&table, argc, argv, &found.operands, &status);
    if (!found.went_on)
        options_free(&table, &found.operands);
    return status;
}

static void release(void) {
    option_list_free(&found.list);
    option_list_free(&found.operands);
}

#define ACCEPT(...)        accept((const char *[]){"sample", __VA_ARGS__, NULL})
#define REFUSE(cause, ...) refuse(cause, (const char *[]){"sample", __VA_ARGS__, NULL})

static void accept(const char *const *arguments) {
    captured_output captured;
    captured_output_run(&captured, parse, arguments);
    assert_true(found.went_on);
    assert_string_equal(captured.errors, "");
    assert_string_equal(captured.output, "");
}

static void refuse(const char *cause, const char *const *arguments) {
    captured_output captured;
    captured_output_run(&captured, parse, arguments);
    assert_false(found.went_on);
    assert_int_equal(captured.status, 2);
    assert_string_equal(captured.output, "");
    assert_int_equal(captured_output_lines(captured.errors), 1);
    assert_true(strncmp(captured.errors, "lobe sample: ", 13) == 0);
    assert_non_null(strstr(captured.errors, "lobe sample --help"));
    if (strstr(captured.errors, cause) == NULL)
        fail_msg("no '%s' in '%s'", cause, captured.errors);
}

static void what_is_not_given_has_its_default(void **state) {
    (void)state;
    ACCEPT("scene");
    assert_false(found.flag);
    assert_string_equal(found.text, "none");
    assert_int_equal(found.integer, 7);
    assert_true(found.number == 0.5);
    assert_int_equal(found.size[0], 1280);
    assert_int_equal(found.size[1], 720);
    assert_false(found.size_given);
    assert_true(found.vector[0] == 0.0f && found.vector[1] == 1.0f);
    assert_int_equal(found.choice, 1);
    assert_int_equal(found.list.count, 0);
    release();
}

static void values_are_taken_in_each_form(void **state) {
    (void)state;
    ACCEPT("--flag", "--text=a=b", "--integer", "4096", "--number", "-1.5e0", "one",
           "--size=1x65535", "--vector", "-1,2.5,+.5", "--choice", "blue");
    assert_true(found.flag && found.size_given);
    assert_string_equal(found.text, "a=b");
    assert_int_equal(found.integer, 4096);
    assert_true(found.number == -1.5);
    assert_int_equal(found.size[0], 1);
    assert_int_equal(found.size[1], 65535);
    assert_true(found.vector[0] == -1.0f && found.vector[1] == 2.5f && found.vector[2] == 0.5f);
    assert_int_equal(found.choice, 2);
    assert_int_equal(found.operands.count, 1);
    assert_string_equal(found.operands.values[0], "one");
    release();
    ACCEPT("-f", "-o", "file", "one");
    assert_true(found.flag);
    assert_string_equal(found.text, "file");
    release();
    ACCEPT("-ofile", "one");
    assert_string_equal(found.text, "file");
    release();
    ACCEPT("one", "--text="); // an empty text is a text
    assert_string_equal(found.text, "");
    release();
}

static void the_last_of_several_counts_but_lists_keep_all(void **state) {
    (void)state;
    ACCEPT("--set", "a=1", "x", "--integer=1", "--set=b=2", "--integer=2", "--set", "--flag");
    assert_int_equal(found.integer, 2);
    assert_int_equal(found.list.count, 3);
    assert_string_equal(found.list.values[0], "a=1");
    assert_string_equal(found.list.values[1], "b=2");
    assert_string_equal(found.list.values[2], "--flag"); // the argument of --set, not a flag
    assert_false(found.flag);
    release();
}

static void two_dashes_end_the_options(void **state) {
    (void)state;
    ACCEPT("--", "--flag", "-");
    assert_false(found.flag);
    assert_int_equal(found.operands.count, 2);
    assert_string_equal(found.operands.values[0], "--flag");
    assert_string_equal(found.operands.values[1], "-");
    release();
}

static void mistakes_are_named(void **state) {
    (void)state;
    REFUSE("--colour", "--colour", "red", "x");
    REFUSE("--fla", "--fla", "x");
    REFUSE("-q", "-q", "x");
    REFUSE("--integer needs", "x", "--integer");
    REFUSE("--flag takes no value", "--flag=yes", "x");
    REFUSE("FIRST [SECOND]", "--flag");
    REFUSE("'three'", "one", "two", "three");
    REFUSE("--help", "--help=me", "x");
}

static void bad_values_are_quoted(void **state) {
    (void)state;
    const char *const integers[] = {
        "", "x", "1.5", "-1", "+1", " 1", "1 ", "0x10", "99999999999999999999"};
    for (size_t index = 0; index < sizeof integers / sizeof integers[0]; index++)
        REFUSE("a whole number", "--integer", integers[index], "x");
    const char *const numbers[] = {"",    "x",     "1,5",  "1e",   " 1",  "nan",
                                   "inf", "1e999", "1.5 ", "0x10", "1-2", "--1"};
    for (size_t index = 0; index < sizeof numbers / sizeof numbers[0]; index++)
        REFUSE("a number", "--number", numbers[index], "x");
    const char *const sizes[] = {"", "12", "12x", "x12", "12X7", "12x7x1", "1.5x2", "-1x2"};
    for (size_t index = 0; index < sizeof sizes / sizeof sizes[0]; index++)
        REFUSE("WIDTHxHEIGHT", "--size", sizes[index], "x");
    const char *const vectors[] = {"", "1,2", "1,2,3,4", "1,,3", "1,2,", "a,b,c", "1, 2,3"};
    for (size_t index = 0; index < sizeof vectors / sizeof vectors[0]; index++)
        REFUSE("three numbers", "--vector", vectors[index], "x");
    REFUSE("one of red, green, blue", "--choice=Red", "x");
    REFUSE("'Red'", "--choice=Red", "x");
}

static void values_out_of_range_come_with_the_range(void **state) {
    (void)state;
    REFUSE("0 is outside [1, 4096]", "--integer=0", "x");
    REFUSE("4097 is outside [1, 4096]", "--integer=4097", "x");
    REFUSE("2.0001 is outside [-2, 2]", "--number=2.0001", "x");
    REFUSE("65536x1 is outside [1x1, 65535x65535]", "--size=65536x1", "x");
    REFUSE("1x0 is outside", "--size=1x0", "x");
    REFUSE("outside", "--vector=1e300,0,0", "x"); // beyond the range of float
}

static void help_tells_defaults_ranges_and_choices(void **state) {
    (void)state;
    captured_output captured;
    captured_output_run(&captured, parse, (const char *[]){"sample", "--help", "--nonsense", NULL});
    assert_false(found.went_on);
    assert_int_equal(captured.status, 0);
    assert_string_equal(captured.errors, "");
    const char *const parts[] = {"Usage: lobe sample [OPTION]... FIRST [SECOND]",
                                 "Samples.",
                                 "-f, --flag",
                                 "-o, --text FILE",
                                 "an integer [1, 4096] (default 7)",
                                 "a number [-2, 2] (default 0.5)",
                                 "a size [1x1, 65535x65535] (default 1280x720)",
                                 "a vector (default 0,1,0)",
                                 "a colour: red, green, blue (default green)",
                                 "a knob (may be repeated)",
                                 "--help"};
    for (size_t index = 0; index < sizeof parts / sizeof parts[0]; index++) {
        if (strstr(captured.output, parts[index]) == NULL)
            fail_msg("no '%s' in '%s'", parts[index], captured.output);
    }
}

static void numbers_stand_alone(void **state) {
    (void)state;
    double values[4];
    assert_true(option_parse_number("-0.25", values));
    assert_true(values[0] == -0.25);
    assert_false(option_parse_number("1,2", values));
    assert_true(option_parse_numbers("1,2,3,4", 4, values));
    assert_true(values[3] == 4.0);
    assert_false(option_parse_numbers("1,2,3", 4, values));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_given_has_its_default),
        cmocka_unit_test(values_are_taken_in_each_form),
        cmocka_unit_test(the_last_of_several_counts_but_lists_keep_all),
        cmocka_unit_test(two_dashes_end_the_options),
        cmocka_unit_test(mistakes_are_named),
        cmocka_unit_test(bad_values_are_quoted),
        cmocka_unit_test(values_out_of_range_come_with_the_range),
        cmocka_unit_test(help_tells_defaults_ranges_and_choices),
        cmocka_unit_test(numbers_stand_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
