#ifndef TESTS_ENGINE_SUPPORT_TEST_SHADERS_H
#define TESTS_ENGINE_SUPPORT_TEST_SHADERS_H

#include <lobe/device.h>

#include "engine/shader/shaders.h"

/// The shaders of tests/engine/shaders, embedded by the build.
extern const engine_shader_code engine_test_shaders[];
extern const size_t engine_test_shaders_count;

/// Adds them to a device.
lobe_result add_test_shaders(lobe_device *device);

/// A device with validation and the test shaders. `pipeline_cache` may be NULL.
lobe_result open_device_with_test_shaders(const lobe_host *host, const char *pipeline_cache,
                                          lobe_device **device);

#endif
