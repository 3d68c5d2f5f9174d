// The frames that `--frames` asks for, their times and their files.

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "tools/render/frame_sequence.h"

static void numbers_repeat_one_picture(void **state) {
    (void)state;
    frame_sequence sequence;
    char path[PATH_MAX];
    assert_true(frame_sequence_parse("4", &sequence));
    assert_int_equal(sequence.count, 4);
    assert_false(sequence.numbered);
    assert_float_equal(frame_sequence_seconds(&sequence, 2.5, 3), 2.5, 0);
    assert_true(frame_sequence_path(&sequence, "a/b.exr", 3, path));
    assert_string_equal(path, "a/b.exr");
}

static void ranges_have_times_and_files(void **state) {
    (void)state;
    frame_sequence sequence;
    char path[PATH_MAX];
    assert_true(frame_sequence_parse("30..32", &sequence));
    assert_int_equal(sequence.count, 3);
    assert_true(sequence.numbered);
    assert_float_equal(frame_sequence_seconds(&sequence, 0.5, 0), 1.5, 1e-12);
    assert_true(frame_sequence_path(&sequence, "a.b/c.d.exr", 2, path));
    assert_string_equal(path, "a.b/c.d-0032.exr");
    assert_true(frame_sequence_parse("0..0", &sequence));
    assert_int_equal(sequence.count, 1);
    assert_true(frame_sequence_parse("99999..100000", &sequence));
    assert_true(frame_sequence_path(&sequence, "c.png", 1, path));
    assert_string_equal(path, "c-100000.png");
    assert_true(frame_sequence_path(&sequence, "c.png", 0, path));
    assert_string_equal(path, "c-099999.png"); // names sort
}

static void anything_else_is_refused(void **state) {
    static const char *const texts[] = {
        "",    "0",   "100001", "-1",    "2.5",       "3..1",
        "1..", "..2", "1...2",  "1..2x", "+1..2",     " 1",
        "1 ",  "x",   "1..-2",  "1e3",   "0..100001", "99999999999999999999"};
    (void)state;
    frame_sequence sequence;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (frame_sequence_parse(texts[i], &sequence))
            fail_msg("'%s' is accepted", texts[i]);
}

static void long_names_are_refused(void **state) {
    (void)state;
    frame_sequence sequence;
    char name[PATH_MAX], path[PATH_MAX];
    memset(name, 'a', sizeof name);
    memcpy(name + PATH_MAX - 5, ".exr", 5);
    assert_true(frame_sequence_parse("1..2", &sequence));
    assert_false(frame_sequence_path(&sequence, name, 0, path));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_repeat_one_picture),
        cmocka_unit_test(ranges_have_times_and_files),
        cmocka_unit_test(anything_else_is_refused),
        cmocka_unit_test(long_names_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
