#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <string.h>

#include "engine/device/features.h"
#include "engine/device/selection.h"
#include "tests/engine/support/log_recorder.h"

// Selection only looks at descriptions, so devices that this machine lacks can be simulated.

static log_recorder recorder;
static lobe_device_feature features[4][ENGINE_FEATURE_COUNT];
static engine_candidate candidates[4];

static void describe(size_t index, const char *name, lobe_device_type type) {
    for (size_t i = 0; i < ENGINE_FEATURE_COUNT; i++)
        features[index][i] = (lobe_device_feature){"someFeature", "some use", i < 3, true};
    candidates[index] = (engine_candidate){
        .information = {.type = type,
                        .vulkan_major = 1,
                        .vulkan_minor = 3,
                        .features = features[index],
                        .feature_count = ENGINE_FEATURE_COUNT},
    };
    snprintf(candidates[index].information.name, sizeof candidates[index].information.name, "%s",
             name);
}

static int make_up_devices(void **state) {
    (void)state;
    log_recorder_start(&recorder);
    describe(0, "Soft Renderer", LOBE_DEVICE_CPU);
    describe(1, "Laptop GPU", LOBE_DEVICE_INTEGRATED_GPU);
    describe(2, "Big GPU 9000", LOBE_DEVICE_DISCRETE_GPU);
    describe(3, "Cloud GPU", LOBE_DEVICE_VIRTUAL_GPU);
    return 0;
}

static void assert_selects(const char *select, size_t expected) {
    size_t selected = SIZE_MAX;
    assert_int_equal(engine_candidates_select(candidates, 4, select, &recorder.host, &selected),
                     LOBE_OK);
    assert_int_equal(selected, expected);
}

static void assert_refuses(const char *select, const char *because) {
    size_t selected = SIZE_MAX;
    const int errors = recorder.errors;
    assert_int_equal(engine_candidates_select(candidates, 4, select, &recorder.host, &selected),
                     LOBE_ERROR_NO_DEVICE);
    assert_int_equal(selected, SIZE_MAX);
    assert_int_equal(recorder.errors, errors + 1);
    assert_non_null(strstr(recorder.last_error, because));
}

static void best_type_comes_first(void **state) {
    (void)state;
    static const size_t order[] = {2, 1, 3, 0};
    for (size_t i = 0; i < 4; i++) {
        assert_selects(NULL, order[i]);
        candidates[order[i]].queue_family = UINT32_MAX; // no longer suitable
    }
    assert_refuses(NULL, "Big GPU 9000");
}

static void name_and_index_overrule_the_type(void **state) {
    (void)state;
    assert_selects("soft", 0);
    assert_selects("3", 3);
    assert_selects("gpu", 2); // the best of those that match
    assert_selects("9000", 2);
    assert_refuses("4", "'4'");
    assert_refuses("2x", "'2x'");
}

static void missing_feature_is_named(void **state) {
    (void)state;
    features[2][1].name = "synchronization2";
    features[2][1].present = false;
    assert_selects(NULL, 1);
    assert_selects("gpu", 1);
    assert_refuses("big", "synchronization2");
    features[2][1].required = false;
    assert_selects("big", 2);
}

static void old_vulkan_is_named(void **state) {
    (void)state;
    candidates[1].information.vulkan_minor = 2;
    assert_refuses("laptop", "1.2");
    candidates[1].information.vulkan_major = 2;
    candidates[1].information.vulkan_minor = 0;
    assert_selects("laptop", 1);
}

static void queue_without_graphics_is_named(void **state) {
    (void)state;
    candidates[3].queue_family = UINT32_MAX;
    assert_refuses("cloud", "graphics and compute");
}

#define WITH_DEVICES(test) cmocka_unit_test_setup(test, make_up_devices)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_DEVICES(best_type_comes_first),
        WITH_DEVICES(name_and_index_overrule_the_type),
        WITH_DEVICES(missing_feature_is_named),
        WITH_DEVICES(old_vulkan_is_named),
        WITH_DEVICES(queue_without_graphics_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
