#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "tools/cli/number_text.h"

static void numbers_read_well(void **state) {
    (void)state;
    assert_string_equal(number_text_of(0.0123456, 3).text, "0.0123");
    assert_string_equal(number_text_of(0.99996, 4).text, "1.000");
    assert_string_equal(number_text_of(9.996, 3).text, "10.0");
    assert_string_equal(number_text_of(14194.3, 4).text, "14194");
    assert_string_equal(number_text_of(-2.5, 2).text, "-2.5");
    assert_string_equal(number_text_of(0, 4).text, "0");
    assert_string_equal(number_text_of(NAN, 4).text, "–");
    assert_string_equal(number_text_of(INFINITY, 4).text, "∞");
    assert_string_equal(number_text_of(1e-30, 3).text, "0.000000000");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_read_well),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
