#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "engine/device/vulkan_check.h"
#include "engine/resource/format.h"
#include "tests/engine/support/log_recorder.h"

static log_recorder recorder;

static VkResult vkPretend(VkResult result) {
    return result;
}

static int start_recorder(void **state) {
    (void)state;
    log_recorder_start(&recorder);
    return 0;
}

static void success_codes_are_silent(void **state) {
    (void)state;
    static const VkResult codes[] = {VK_SUCCESS, VK_INCOMPLETE, VK_TIMEOUT, VK_NOT_READY};
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++)
        assert_int_equal(VULKAN_CHECK(&recorder.host, vkPretend(codes[i]), "thing"), LOBE_OK);
    assert_int_equal(recorder.errors, 0);
}

static void errors_become_lobes_own(void **state) {
    (void)state;
    const struct {
        VkResult vulkan;
        lobe_result expected;
    } pairs[] = {
        {VK_ERROR_OUT_OF_HOST_MEMORY, LOBE_ERROR_OUT_OF_MEMORY},
        {VK_ERROR_OUT_OF_DEVICE_MEMORY, LOBE_ERROR_OUT_OF_DEVICE_MEMORY},
        {VK_ERROR_DEVICE_LOST, LOBE_ERROR_DEVICE_LOST},
        {VK_ERROR_FORMAT_NOT_SUPPORTED, LOBE_ERROR_UNSUPPORTED},
        {VK_ERROR_INCOMPATIBLE_DRIVER, LOBE_ERROR_NO_DEVICE},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        assert_int_equal(engine_vulkan_result(pairs[i].vulkan), pairs[i].expected);
    assert_int_not_equal(engine_vulkan_result((VkResult)-12345678), LOBE_OK);
}

static void line_names_purpose_function_and_code(void **state) {
    (void)state;
    assert_int_equal(
        VULKAN_CHECK(&recorder.host, vkPretend(VK_ERROR_DEVICE_LOST), "image '%s'", "colours"),
        LOBE_ERROR_DEVICE_LOST);
    assert_int_equal(recorder.errors, 1);
    assert_string_equal(recorder.last_error,
                        "image 'colours': vkPretend gave VK_ERROR_DEVICE_LOST");
}

static void every_format_has_its_own_vulkan_format(void **state) {
    (void)state;
    assert_int_equal(engine_format_vulkan(LOBE_FORMAT_NONE), VK_FORMAT_UNDEFINED);
    assert_int_equal(engine_format_vulkan(LOBE_FORMAT_COUNT), VK_FORMAT_UNDEFINED);
    for (int i = 1; i < LOBE_FORMAT_COUNT; i++)
        for (int j = 0; j < i; j++)
            assert_int_not_equal(engine_format_vulkan((lobe_format)i),
                                 engine_format_vulkan((lobe_format)j));
    assert_int_equal(engine_format_aspect(LOBE_FORMAT_D32_FLOAT), VK_IMAGE_ASPECT_DEPTH_BIT);
    assert_int_equal(engine_format_aspect(LOBE_FORMAT_R32_FLOAT), VK_IMAGE_ASPECT_COLOR_BIT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(success_codes_are_silent, start_recorder),
        cmocka_unit_test(errors_become_lobes_own),
        cmocka_unit_test_setup(line_names_purpose_function_and_code, start_recorder),
        cmocka_unit_test(every_format_has_its_own_vulkan_format),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
