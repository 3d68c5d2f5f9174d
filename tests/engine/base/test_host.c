#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include <lobe/host.h>

#include "tests/engine/support/log_recorder.h"

static void a_line_has_its_level(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_host_log(&recorder.host, LOBE_LOG_WARNING, "%d of %s", 3, "four");
    assert_string_equal(recorder.last_warning, "3 of four");
    assert_int_equal(recorder.warnings, 1);
    assert_int_equal(recorder.errors, 0);
}

static void a_failure_is_logged_and_returned(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_int_equal(lobe_host_fail(&recorder.host, LOBE_ERROR_LIMIT, "%s: too large", "file"),
                     LOBE_ERROR_LIMIT);
    assert_string_equal(recorder.last_error, "file: too large");
    assert_int_equal(recorder.errors, 1);
}

static void nobody_need_listen(void **state) {
    (void)state;
    const lobe_host deaf = {0};
    lobe_host_log(NULL, LOBE_LOG_ERROR, "unheard");
    lobe_host_log(&deaf, LOBE_LOG_ERROR, "unheard");
    assert_int_equal(lobe_host_fail(NULL, LOBE_ERROR_READ, "unheard"), LOBE_ERROR_READ);
    assert_int_equal(lobe_host_fail(&deaf, LOBE_ERROR_READ, "unheard"), LOBE_ERROR_READ);
}

/// A name from a file must neither forge a second line nor control a terminal.
static void a_message_is_one_line_without_control_characters(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_host_fail(&recorder.host, LOBE_ERROR_READ, "a\nb\tc\x1b[2Jd\x7f \xc3\xa9");
    assert_string_equal(recorder.last_error, "a?b?c?[2Jd? \xc3\xa9");
}

static void a_long_message_is_cut(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_host_log(&recorder.host, LOBE_LOG_ERROR, "%5000d", 7);
    assert_int_equal(strlen(recorder.last_error), 1023);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_has_its_level),
        cmocka_unit_test(a_failure_is_logged_and_returned),
        cmocka_unit_test(nobody_need_listen),
        cmocka_unit_test(a_message_is_one_line_without_control_characters),
        cmocka_unit_test(a_long_message_is_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
