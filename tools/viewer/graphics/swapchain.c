#include "tools/viewer/graphics/swapchain.h"

#include "engine/device/vulkan_check.h"

/// Nanoseconds: how long mouse and keys may wait while the window is covered.
#define PATIENCE 100000000

static viewer_shown judge(const viewer_device *device, VkResult code, const char *what,
                          lobe_result *result) {
    *result = LOBE_OK;
    if (code == VK_TIMEOUT || code == VK_NOT_READY)
        return VIEWER_BUSY;
    if (code == VK_ERROR_OUT_OF_DATE_KHR)
        return VIEWER_OUT_OF_DATE;
    if (code == VK_ERROR_SURFACE_LOST_KHR)
        return VIEWER_SURFACE_LOST;
    *result = engine_vulkan_check(&device->host, code, what, "window's images");
    return *result == LOBE_OK ? VIEWER_SHOWN : VIEWER_FAILED;
}

/// The viewer's shader encodes colours itself, so an _SRGB format, which would encode them again,
/// is not usable.
static bool is_usable(const VkSurfaceFormatKHR *format) {
    return (format->format == VK_FORMAT_B8G8R8A8_UNORM ||
            format->format == VK_FORMAT_R8G8B8A8_UNORM) &&
           format->colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
}

static viewer_shown choose_format(const viewer_device *device, VkSurfaceFormatKHR *chosen,
                                  lobe_result *result) {
    VkSurfaceFormatKHR formats[64];
    uint32_t count = 64;
    const VkResult listed = vkGetPhysicalDeviceSurfaceFormatsKHR(device->vulkan.physical_device,
                                                                 device->surface, &count, formats);
    const viewer_shown asked =
        judge(device, listed, "vkGetPhysicalDeviceSurfaceFormatsKHR", result);
    for (uint32_t i = 0; asked == VIEWER_SHOWN && i < count; i++) {
        if (!is_usable(&formats[i]))
            continue;
        *chosen = formats[i];
        return VIEWER_SHOWN;
    }
    if (asked == VIEWER_SHOWN)
        *result = lobe_host_fail(&device->host, LOBE_ERROR_UNSUPPORTED,
                                 "window: does not support images with 8 bits per channel");
    return asked == VIEWER_SHOWN ? VIEWER_FAILED : asked;
}

static uint32_t clamp(uint32_t value, uint32_t minimum, uint32_t maximum) {
    return value < minimum ? minimum : value > maximum ? maximum : value;
}

static VkExtent2D choose_extent(const VkSurfaceCapabilitiesKHR *surface, uint32_t width,
                                uint32_t height) {
    if (surface->currentExtent.width != UINT32_MAX)
        return surface->currentExtent;
    return (VkExtent2D){
        clamp(width, surface->minImageExtent.width, surface->maxImageExtent.width),
        clamp(height, surface->minImageExtent.height, surface->maxImageExtent.height)};
}

static VkCompositeAlphaFlagBitsKHR choose_alpha(VkCompositeAlphaFlagsKHR supported) {
    return supported & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                         : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

static lobe_result create_semaphores(const viewer_device *device, viewer_swapchain *swapchain) {
    const VkSemaphoreCreateInfo create = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkDevice vulkan = device->vulkan.device;
    lobe_result result =
        VULKAN_CHECK(&device->host, vkCreateSemaphore(vulkan, &create, NULL, &swapchain->acquired),
                     "window's images");
    for (uint32_t i = 0; result == LOBE_OK && i < swapchain->count; i++)
        result = VULKAN_CHECK(&device->host,
                              vkCreateSemaphore(vulkan, &create, NULL, &swapchain->drawn[i]),
                              "window's images");
    return result;
}

static lobe_result take_images(const viewer_device *device, const VkSwapchainCreateInfoKHR *create,
                               viewer_swapchain *swapchain) {
    uint32_t count = VIEWER_MAXIMUM_IMAGES;
    const lobe_result result =
        VULKAN_CHECK(&device->host,
                     vkGetSwapchainImagesKHR(device->vulkan.device, swapchain->swapchain, &count,
                                             swapchain->images),
                     "window's images");
    if (result != LOBE_OK)
        return result;
    swapchain->count = count;
    swapchain->width = create->imageExtent.width;
    swapchain->height = create->imageExtent.height;
    swapchain->format = create->imageFormat;
    return create_semaphores(device, swapchain);
}

static viewer_shown create_swapchain(const viewer_device *device,
                                     const VkSwapchainCreateInfoKHR *create,
                                     viewer_swapchain *swapchain, lobe_result *result) {
    const VkResult code =
        vkCreateSwapchainKHR(device->vulkan.device, create, NULL, &swapchain->swapchain);
    viewer_shown made = judge(device, code, "vkCreateSwapchainKHR", result);
    if (made == VIEWER_SHOWN)
        *result = take_images(device, create, swapchain);
    if (*result != LOBE_OK)
        made = VIEWER_FAILED;
    if (made != VIEWER_SHOWN)
        viewer_swapchain_destroy(device, swapchain);
    return made;
}

/// Two images at least: one is shown while the next is drawn.
static VkSwapchainCreateInfoKHR describe(const viewer_device *device,
                                         const VkSurfaceCapabilitiesKHR *surface,
                                         const VkSurfaceFormatKHR *format, VkExtent2D extent) {
    return (VkSwapchainCreateInfoKHR){
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = device->surface,
        .minImageCount = clamp(2, surface->minImageCount,
                               surface->maxImageCount ? surface->maxImageCount : UINT32_MAX),
        .imageFormat = format->format,
        .imageColorSpace = format->colorSpace,
        .imageExtent = extent,
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
        .preTransform = surface->currentTransform,
        .compositeAlpha = choose_alpha(surface->supportedCompositeAlpha),
        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
        .clipped = VK_TRUE,
    };
}

viewer_shown viewer_swapchain_renew(const viewer_device *device, uint32_t width, uint32_t height,
                                    viewer_swapchain *swapchain, lobe_result *result) {
    viewer_swapchain_destroy(device, swapchain);
    VkSurfaceCapabilitiesKHR surface;
    VkSurfaceFormatKHR format = {0};
    const VkResult code = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device->vulkan.physical_device,
                                                                    device->surface, &surface);
    viewer_shown asked = judge(device, code, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR", result);
    if (asked == VIEWER_SHOWN)
        asked = choose_format(device, &format, result);
    if (asked != VIEWER_SHOWN)
        return asked;
    const VkExtent2D extent = choose_extent(&surface, width, height);
    if (extent.width == 0 || extent.height == 0)
        return VIEWER_SHOWN;
    const VkSwapchainCreateInfoKHR create = describe(device, &surface, &format, extent);
    return create_swapchain(device, &create, swapchain, result);
}

void viewer_swapchain_destroy(const viewer_device *device, viewer_swapchain *swapchain) {
    VkDevice vulkan = device->vulkan.device;
    if (!vulkan)
        return;
    for (uint32_t i = 0; i < swapchain->count; i++)
        vkDestroySemaphore(vulkan, swapchain->drawn[i], NULL);
    vkDestroySemaphore(vulkan, swapchain->acquired, NULL);
    if (swapchain->swapchain)
        vkDestroySwapchainKHR(vulkan, swapchain->swapchain, NULL);
    *swapchain = (viewer_swapchain){0};
}

viewer_shown viewer_swapchain_acquire(const viewer_device *device, viewer_swapchain *swapchain,
                                      lobe_result *result) {
    const VkResult code =
        vkAcquireNextImageKHR(device->vulkan.device, swapchain->swapchain, PATIENCE,
                              swapchain->acquired, VK_NULL_HANDLE, &swapchain->current);
    swapchain->fits_badly = code == VK_SUBOPTIMAL_KHR;
    return judge(device, code, "vkAcquireNextImageKHR", result);
}

/// A suboptimal image is shown, but the next swapchain may be optimal. Not if none ever was: that
/// would recreate it forever.
static viewer_shown judge_fit(viewer_swapchain *swapchain, VkResult code) {
    const bool badly = swapchain->fits_badly || code == VK_SUBOPTIMAL_KHR;
    const bool fitted = swapchain->fits;
    swapchain->fits = !badly;
    return badly && fitted ? VIEWER_OUT_OF_DATE : VIEWER_SHOWN;
}

viewer_shown viewer_swapchain_present(const viewer_device *device, viewer_swapchain *swapchain,
                                      lobe_result *result) {
    const VkPresentInfoKHR present = {
        .sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
        .waitSemaphoreCount = 1,
        .pWaitSemaphores = &swapchain->drawn[swapchain->current],
        .swapchainCount = 1,
        .pSwapchains = &swapchain->swapchain,
        .pImageIndices = &swapchain->current,
    };
    const VkResult code = vkQueuePresentKHR(device->vulkan.queue, &present);
    const viewer_shown shown = judge(device, code, "vkQueuePresentKHR", result);
    return shown == VIEWER_SHOWN ? judge_fit(swapchain, code) : shown;
}
