#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include <lobe/device.h>

#include "tests/engine/support/log_recorder.h"

static log_recorder recorder;

static int start_recorder(void **state) {
    (void)state;
    log_recorder_start(&recorder);
    return 0;
}

static lobe_result create(const char *select, lobe_device **device) {
    return lobe_device_create(&(lobe_device_parameters){.select = select, .host = &recorder.host},
                              device);
}

static void assert_refused(const char *select) {
    lobe_device *device = (lobe_device *)&recorder;
    assert_int_equal(create(select, &device), LOBE_ERROR_NO_DEVICE);
    assert_null(device);
    assert_int_equal(recorder.errors, 1);
}

static void defaults_give_a_device(void **state) {
    (void)state;
    lobe_device *device = NULL;
    assert_int_equal(lobe_device_create(NULL, &device), LOBE_OK);
    const lobe_device_information *information = lobe_device_describe(device);
    assert_true(strlen(information->name) > 0);
    assert_true(strlen(information->driver) > 0);
    assert_true(information->vulkan_major > 1 || information->vulkan_minor >= 3);
    assert_true(information->maximum_image_extent >= 4096);
    assert_true(information->memory_bytes > 0);
    lobe_device_destroy(&device);
    assert_null(device);
    lobe_device_destroy(&device);
}

static void required_features_are_present(void **state) {
    (void)state;
    lobe_device *device = NULL;
    assert_int_equal(create(NULL, &device), LOBE_OK);
    const lobe_device_information *information = lobe_device_describe(device);
    bool synchronization2 = false;
    assert_true(information->feature_count > 3);
    for (size_t i = 0; i < information->feature_count; i++) {
        const lobe_device_feature *feature = &information->features[i];
        assert_true(feature->present || !feature->required);
        assert_true(strlen(feature->use) > 0);
        synchronization2 |= feature->present && !strcmp(feature->name, "synchronization2");
    }
    assert_true(synchronization2);
    lobe_device_destroy(&device);
}

static void devices_are_listed_and_selected(void **state) {
    (void)state;
    lobe_device_information *devices = NULL;
    size_t count = 0;
    assert_int_equal(
        lobe_device_list(&(lobe_device_parameters){.host = &recorder.host}, &devices, &count),
        LOBE_OK);
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++) {
        const char index[] = {(char)('0' + i), '\0'};
        lobe_device *device = NULL;
        assert_int_equal(create(index, &device), LOBE_OK);
        assert_string_equal(lobe_device_describe(device)->name, devices[i].name);
        assert_int_equal(lobe_device_describe(device)->type, devices[i].type);
        lobe_device_destroy(&device);
    }
    lobe_device_list_free(&devices, count);
    assert_null(devices);
    lobe_device_list_free(&devices, 0);
}

/// Mesa's software renderer.
static bool llvmpipe_is_installed(void) {
    bool found = false;
    lobe_device_information *devices = NULL;
    size_t count = 0;
    assert_int_equal(
        lobe_device_list(&(lobe_device_parameters){.host = &recorder.host}, &devices, &count),
        LOBE_OK);
    for (size_t i = 0; i < count; i++)
        found |= strstr(devices[i].name, "llvmpipe") != NULL;
    lobe_device_list_free(&devices, count);
    return found;
}

static void part_of_a_name_in_any_case_selects(void **state) {
    (void)state;
    lobe_device *device = NULL;
    if (!llvmpipe_is_installed())
        skip();
    assert_int_equal(create("LLVMpipe", &device), LOBE_OK);
    assert_int_equal(lobe_device_describe(device)->type, LOBE_DEVICE_CPU);
    assert_non_null(strstr(lobe_device_describe(device)->name, "llvmpipe"));
    assert_non_null(strstr(lobe_device_describe(device)->driver, "Mesa"));
    lobe_device_destroy(&device);
    assert_int_equal(recorder.errors, 0);
}

static void wrong_name_is_refused_and_named(void **state) {
    (void)state;
    assert_refused("no such device");
    assert_non_null(strstr(recorder.last_error, "no such device"));
}

static void index_out_of_range_is_refused(void **state) {
    (void)state;
    assert_refused("1000");
}

/// An environment variable with what it was before (NULL: unset).
typedef struct variable {
    const char *name;
    char *before;
} variable;

static variable replace(const char *name, const char *value) {
    const char *before = getenv(name);
    variable result = {name, before ? strdup(before) : NULL};
    setenv(name, value, 1);
    return result;
}

static void restore(variable *changed) {
    if (changed->before)
        setenv(changed->name, changed->before, 1);
    else
        unsetenv(changed->name);
    free(changed->before);
}

static void without_a_driver_there_is_no_device(void **state) {
    (void)state;
    lobe_device_information *devices = NULL;
    size_t count = 1;
    variable files = replace("VK_DRIVER_FILES", "/nonexistent");
    variable names = replace("VK_ICD_FILENAMES", "/nonexistent");
    assert_refused(NULL);
    assert_int_equal(
        lobe_device_list(&(lobe_device_parameters){.host = &recorder.host}, &devices, &count),
        LOBE_ERROR_NO_DEVICE);
    assert_null(devices);
    assert_int_equal(count, 0);
    assert_int_equal(recorder.errors, 2);
    restore(&files);
    restore(&names);
}

static void missing_validation_layer_is_unsupported(void **state) {
    (void)state;
    lobe_device *device = NULL;
    variable path = replace("VK_LAYER_PATH", "/nonexistent");
    assert_int_equal(
        lobe_device_create(&(lobe_device_parameters){.validation = true, .host = &recorder.host},
                           &device),
        LOBE_ERROR_UNSUPPORTED);
    restore(&path);
    assert_null(device);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "VK_LAYER_KHRONOS_validation"));
}

static void validation_is_silent_without_mistakes(void **state) {
    (void)state;
    lobe_device *device = NULL;
    assert_int_equal(
        lobe_device_create(&(lobe_device_parameters){.validation = true, .host = &recorder.host},
                           &device),
        LOBE_OK);
    assert_int_equal(lobe_device_validation_count(device), 0);
    lobe_device_destroy(&device);
    assert_int_equal(recorder.errors, 0);
}

static void types_have_names(void **state) {
    (void)state;
    assert_string_equal(lobe_device_type_name(LOBE_DEVICE_DISCRETE_GPU), "discrete GPU");
    assert_string_equal(lobe_device_type_name(LOBE_DEVICE_CPU), "CPU");
    assert_non_null(lobe_device_type_name((lobe_device_type)99));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(defaults_give_a_device, start_recorder),
        cmocka_unit_test_setup(required_features_are_present, start_recorder),
        cmocka_unit_test_setup(devices_are_listed_and_selected, start_recorder),
        cmocka_unit_test_setup(part_of_a_name_in_any_case_selects, start_recorder),
        cmocka_unit_test_setup(wrong_name_is_refused_and_named, start_recorder),
        cmocka_unit_test_setup(index_out_of_range_is_refused, start_recorder),
        cmocka_unit_test_setup(without_a_driver_there_is_no_device, start_recorder),
        cmocka_unit_test_setup(missing_validation_layer_is_unsupported, start_recorder),
        cmocka_unit_test_setup(validation_is_silent_without_mistakes, start_recorder),
        cmocka_unit_test(types_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
