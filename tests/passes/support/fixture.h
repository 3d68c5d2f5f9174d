#ifndef TESTS_PASSES_SUPPORT_FIXTURE_H
#define TESTS_PASSES_SUPPORT_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <lobe/device.h>
#include <lobe/graph.h>
#include <lobe/renderer.h>

/// The fixture of pass tests: a device, and a log that records messages.
typedef struct fixture {
    lobe_device *device;
    lobe_graph *graph;       ///< for tests that declare passes themselves
    lobe_renderer *renderer; ///< for tests that draw pictures
    const lobe_scene *held;  ///< see hold_scene
    const char *fits_cache;  ///< folder for the maps that pictures fit; NULL: none
    lobe_host host;
    unsigned errors, warnings; ///< lines so far
    char error[1024];          ///< the last error line
} fixture;

/// Group set-up and tear-down. Without a Vulkan device the tests fail.
int fixture_create(void **state);
int fixture_destroy(void **state);
/// The same under the Khronos validation layer.
int fixture_create_validated(void **state);

/// A last test: neither the validation layer nor the library has reported an error.
void validation_is_silent(void **state);

/// A separate device with the fixture's log; asserts success.
lobe_device *fixture_device(fixture *f, lobe_device_parameters parameters);

/// What samplers may add to the error of values between -1 and 1: GPUs blend texels with weights in
/// steps of 1/256, along either axis. 0 on CPUs.
double fixture_sampler_error(const fixture *f);
/// Skips the test where samplers round: a point at a bin's edge may fall on its other side there.
void fixture_need_exact_sampler(const fixture *f);

void fixture_forget_messages(fixture *f);

/// Asserts a failure with exactly this code, logged in exactly one line that contains `words`.
void assert_failure(const fixture *f, lobe_result result, lobe_result expected, const char *words);

/// Passes of the last frame of a graph with a name (NULL: any) and state.
size_t count_passes(const lobe_graph *graph, const char *name, lobe_pass_state state);

#endif
