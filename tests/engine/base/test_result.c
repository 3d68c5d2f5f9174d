#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include <lobe/result.h>

static void every_result_has_its_own_name_and_message(void **state) {
    (void)state;
    for (int i = 0; i < LOBE_RESULT_COUNT; i++) {
        const char *name = lobe_result_name((lobe_result)i);
        assert_true(!strcmp(name, "LOBE_OK") || !strncmp(name, "LOBE_ERROR_", 11));
        assert_true(strlen(lobe_result_message((lobe_result)i)) > 3);
        for (int j = 0; j < i; j++) {
            assert_string_not_equal(name, lobe_result_name((lobe_result)j));
            assert_string_not_equal(lobe_result_message((lobe_result)i),
                                    lobe_result_message((lobe_result)j));
        }
    }
    assert_string_equal(lobe_result_name(LOBE_ERROR_NOT_FOUND), "LOBE_ERROR_NOT_FOUND");
    assert_string_equal(lobe_result_message(LOBE_ERROR_NOT_FOUND), "not found");
}

static void values_out_of_range_are_named_too(void **state) {
    (void)state;
    assert_string_equal(lobe_result_name(LOBE_RESULT_COUNT), "unknown lobe_result");
    assert_non_null(lobe_result_message((lobe_result)-1));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_result_has_its_own_name_and_message),
        cmocka_unit_test(values_out_of_range_are_named_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
