#ifndef TESTS_SHADERS_SUPPORT_HARNESS_H
#define TESTS_SHADERS_SUPPORT_HARNESS_H

#include <stddef.h>
#include <stdint.h>

/// Runs functions of shaders/lib on the device and returns their values. The set-up and tear-down
/// are those of a cmocka group; the device is kept in its state.

/// Arguments of one call; the shader defines their meaning.
typedef struct harness_arguments {
    float a[4], b[4], c[4];
} harness_arguments;

/// Values of one call.
typedef struct harness_result {
    float value[4];
} harness_result;

int harness_set_up(void **state);
int harness_tear_down(void **state);

/// Calls function number `function` of tests/shaders/`shader` `count` times. Fails the test if the
/// device fails.
void harness_evaluate(void **state, const char *shader, uint32_t function,
                      const harness_arguments *arguments, size_t count, harness_result *results);

#endif
