#include "tools/viewer/graphics/graphics.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "engine/device/vulkan_check.h"
#include "third_party/imgui.h"
#include "tools/viewer/viewer.h"

/// Losses in a row, without a picture shown in between, after which the viewer gives up.
#define MAXIMUM_LOSSES 3

lobe_result viewer_graphics_open(viewer *v) {
    lobe_result result = viewer_device_open(&v->request->device, v->window, &v->host, &v->device);
    if (result == LOBE_OK)
        result = viewer_frame_open(&v->device, &v->frame);
    if (result == LOBE_OK)
        result = viewer_display_open(&v->device, &v->display);
    for (int i = 0; i < 2 && result == LOBE_OK; i++)
        result = viewer_side_open(&v->view, &v->sides[i]);
    v->view.width = v->view.height = 0; // images are created with the swapchain
    v->swapchain_is_stale = true;
    return result;
}

void viewer_graphics_close(viewer *v) {
    if (v->device.vulkan.device)
        vkDeviceWaitIdle(v->device.vulkan.device);
    viewer_frame_close(&v->device, &v->frame);
    for (int i = 0; i < 2; i++)
        viewer_side_close(&v->view, &v->sides[i]);
    viewer_display_close(&v->display);
    viewer_swapchain_destroy(&v->device, &v->swapchain);
    viewer_device_close(&v->device);
}

/// No frame may be in flight when objects that it uses are recreated.
static lobe_result finish(viewer *v) {
    lobe_result result = viewer_frame_finish(&v->device, &v->frame, v->sides);
    if (result == LOBE_OK)
        result = VULKAN_CHECK(&v->host, vkDeviceWaitIdle(v->device.vulkan.device), "window");
    return result;
}

static lobe_result resize_sides(viewer *v) {
    lobe_result result = LOBE_OK;
    if (v->view.width == v->swapchain.width && v->view.height == v->swapchain.height)
        return LOBE_OK;
    v->view.width = v->swapchain.width;
    v->view.height = v->swapchain.height;
    for (int i = 0; i < 2 && result == LOBE_OK; i++)
        result = viewer_side_resize(&v->view, &v->sides[i]);
    return result;
}

lobe_result viewer_graphics_resize(viewer *v) {
    int width = 0, height = 0;
    lobe_result result = finish(v);
    if (result != LOBE_OK)
        return result;
    glfwGetFramebufferSize(v->window, &width, &height);
    const viewer_shown made = viewer_swapchain_renew(&v->device, (uint32_t)width, (uint32_t)height,
                                                     &v->swapchain, &result);
    if (made != VIEWER_SHOWN)
        return viewer_graphics_handle_result(v, made, result);
    if (v->swapchain.count == 0)
        return LOBE_OK;
    v->swapchain_is_stale = false;
    return resize_sides(v);
}

lobe_result viewer_graphics_rescale(viewer *v) {
    lobe_result result = finish(v);
    v->scale_is_stale = false;
    if (result == LOBE_OK && !imgui_rescale(v->scale))
        result = lobe_host_fail(&v->host, LOBE_ERROR_OUT_OF_MEMORY, "panels: out of memory");
    return result == LOBE_OK ? viewer_display_renew_font(&v->device, &v->display) : result;
}

static lobe_result renew_surface(viewer *v) {
    if (++v->losses > MAXIMUM_LOSSES)
        return lobe_host_fail(&v->host, LOBE_ERROR_UNSUPPORTED,
                              "window: the surface was lost repeatedly, giving up");
    lobe_host_log(&v->host, LOBE_LOG_WARNING, "the window's surface was lost, creating a new one");
    lobe_result result = finish(v);
    viewer_swapchain_destroy(&v->device, &v->swapchain);
    return result == LOBE_OK ? viewer_device_renew_surface(&v->device, v->window) : result;
}

lobe_result viewer_graphics_handle_result(viewer *v, viewer_shown shown, lobe_result result) {
    if (shown == VIEWER_SHOWN)
        return LOBE_OK;
    if (shown == VIEWER_FAILED)
        return result;
    viewer_redraw_panels(v); // redraw the frame that was not shown
    if (shown == VIEWER_BUSY)
        return LOBE_OK;
    v->swapchain_is_stale = true;
    return shown == VIEWER_SURFACE_LOST ? renew_surface(v) : LOBE_OK;
}

lobe_result viewer_graphics_recover(viewer *v) {
    lobe_result result = LOBE_ERROR_DEVICE_LOST;
    const uint64_t faults = v->device.fault_count;
    while (result == LOBE_ERROR_DEVICE_LOST && ++v->losses <= MAXIMUM_LOSSES) {
        lobe_host_log(&v->host, LOBE_LOG_WARNING, "the device was lost, reopening it");
        viewer_graphics_close(v);
        result = viewer_graphics_open(v);
    }
    v->device.fault_count += faults;
    return result != LOBE_ERROR_DEVICE_LOST
               ? result
               : lobe_host_fail(&v->host, result, "the device was lost repeatedly, giving up");
}
