#include "tools/viewer/swapchain.h"

#include "engine/vulkan_check.h"

/// Colours leave the viewer's shader encoded: a format that encoded them again would not do.
static lobe_result choose_format(const viewer_device *device, VkSurfaceFormatKHR *chosen) {
    static const VkFormat usable[] = {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM};
    VkSurfaceFormatKHR formats[64];
    uint32_t count = 64;
    const VkResult listed = vkGetPhysicalDeviceSurfaceFormatsKHR(device->vulkan.physical_device,
                                                                 device->surface, &count, formats);
    lobe_result result = VULKAN_CHECK(&device->log, listed, "window's surface");
    for (uint32_t i = 0; result == LOBE_OK && i < count; i++) {
        for (size_t k = 0; k < sizeof usable / sizeof *usable; k++) {
            if (formats[i].format != usable[k] ||
                formats[i].colorSpace != VK_COLOR_SPACE_SRGB_NONLINEAR_KHR)
                continue;
            *chosen = formats[i];
            return LOBE_OK;
        }
    }
    return result != LOBE_OK ? result
                             : lobe_log_fail(&device->log, LOBE_ERROR_UNSUPPORTED,
                                             "window: takes no pictures of 8 bits a channel");
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
        VULKAN_CHECK(&device->log, vkCreateSemaphore(vulkan, &create, NULL, &swapchain->acquired),
                     "window's images");
    for (uint32_t i = 0; result == LOBE_OK && i < swapchain->count; i++)
        result = VULKAN_CHECK(&device->log,
                              vkCreateSemaphore(vulkan, &create, NULL, &swapchain->drawn[i]),
                              "window's images");
    return result;
}

static lobe_result create_swapchain(const viewer_device *device,
                                    const VkSwapchainCreateInfoKHR *create,
                                    viewer_swapchain *swapchain) {
    VkDevice vulkan = device->vulkan.device;
    lobe_result result = VULKAN_CHECK(
        &device->log, vkCreateSwapchainKHR(vulkan, create, NULL, &swapchain->swapchain),
        "window's images");
    uint32_t count = VIEWER_MAXIMUM_IMAGES;
    if (result == LOBE_OK)
        result = VULKAN_CHECK(
            &device->log,
            vkGetSwapchainImagesKHR(vulkan, swapchain->swapchain, &count, swapchain->images),
            "window's images");
    if (result != LOBE_OK)
        return result;
    swapchain->count = count;
    swapchain->width = create->imageExtent.width;
    swapchain->height = create->imageExtent.height;
    swapchain->format = create->imageFormat;
    return create_semaphores(device, swapchain);
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

lobe_result viewer_swapchain_renew(const viewer_device *device, uint32_t width, uint32_t height,
                                   viewer_swapchain *swapchain) {
    viewer_swapchain_destroy(device, swapchain);
    VkSurfaceCapabilitiesKHR surface;
    VkSurfaceFormatKHR format = {0};
    const VkResult asked = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device->vulkan.physical_device,
                                                                     device->surface, &surface);
    lobe_result result = VULKAN_CHECK(&device->log, asked, "window's surface");
    if (result == LOBE_OK)
        result = choose_format(device, &format);
    if (result != LOBE_OK)
        return result;
    const VkExtent2D extent = choose_extent(&surface, width, height);
    if (extent.width == 0 || extent.height == 0)
        return LOBE_OK;
    const VkSwapchainCreateInfoKHR create = describe(device, &surface, &format, extent);
    result = create_swapchain(device, &create, swapchain);
    if (result != LOBE_OK)
        viewer_swapchain_destroy(device, swapchain);
    return result;
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

/// A suboptimal image shows; a resize will say what it should be.
static viewer_shown judge(const viewer_device *device, VkResult code, const char *what,
                          lobe_result *result) {
    *result = LOBE_OK;
    if (code == VK_SUCCESS || code == VK_SUBOPTIMAL_KHR)
        return VIEWER_SHOWN;
    if (code == VK_ERROR_OUT_OF_DATE_KHR)
        return VIEWER_OUT_OF_DATE;
    if (code == VK_ERROR_SURFACE_LOST_KHR)
        return VIEWER_SURFACE_LOST;
    *result = engine_vulkan_check(&device->log, code, what, "window's images");
    return VIEWER_FAILED;
}

viewer_shown viewer_swapchain_acquire(const viewer_device *device, viewer_swapchain *swapchain,
                                      lobe_result *result) {
    return judge(device,
                 vkAcquireNextImageKHR(device->vulkan.device, swapchain->swapchain, UINT64_MAX,
                                       swapchain->acquired, VK_NULL_HANDLE, &swapchain->current),
                 "vkAcquireNextImageKHR", result);
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
    return judge(device, vkQueuePresentKHR(device->vulkan.queue, &present), "vkQueuePresentKHR",
                 result);
}
