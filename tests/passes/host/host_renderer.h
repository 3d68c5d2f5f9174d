#ifndef TESTS_PASSES_HOST_HOST_RENDERER_H
#define TESTS_PASSES_HOST_HOST_RENDERER_H

#include <lobe/renderer.h>

#include "tests/engine/support/host_device.h"

/// Opens a host's Vulkan device, imports it into lobe, and creates a renderer on it that logs to
/// the host. Asserts success. The caller destroys the renderer, then the device, and closes the
/// host.
lobe_renderer *host_renderer_open(host_device *host, lobe_device **device);

#endif
