#include "tests/passes/host/host_renderer.h"

#include "tests/passes/support/fixture.h"

lobe_renderer *host_renderer_open(host_device *host, lobe_device **device) {
    lobe_renderer *renderer;
    host_device_open(host);
    *device = host_device_import(host);
    assert_int_equal(lobe_renderer_create(*device, &host->recorder.host, &renderer), LOBE_OK);
    return renderer;
}
