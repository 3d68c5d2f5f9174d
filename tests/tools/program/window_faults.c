// Preloaded into `lobe view`: makes Vulkan fail, and monitors change, as specified by the file that
// LOBE_TEST_FAULT names. Its lines are executed in order and removed: "FUNCTION CODE" makes the
// next call of a function return that VkResult, "scale NUMBER" sets the scale of the window's
// content from then on, "unit NUMBER" the number of pixels of the window's unit. A device or a
// surface that is lost stays lost until it is destroyed.

#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <vulkan/vulkan.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

static bool device_is_lost, surface_is_lost;
static float scale;
static double unit = 1;
static GLFWwindow *scaled_window;
static GLFWwindowcontentscalefun on_scale;
static GLFWcursorposfun on_cursor;

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

/// Removes the first line of a file, and the file with its last line.
static void take_line(const char *path, FILE *file) {
    char rest[1024];
    const size_t size = fread(rest, 1, sizeof rest, file);
    FILE *shorter = size > 0 ? fopen(path, "w") : NULL;
    if (!shorter) {
        unlink(path);
        return;
    }
    fwrite(rest, 1, size, shorter);
    fclose(shorter);
}

/// The number in the file's first line if it begins with this name; otherwise false.
static bool is_told(const char *name, double *number) {
    const char *path = getenv("LOBE_TEST_FAULT");
    FILE *file = path ? fopen(path, "r") : NULL;
    char told[64] = "";
    if (!file)
        return false;
    const bool found = fscanf(file, "%63s %lf\n", told, number) == 2 && strcmp(told, name) == 0;
    if (found)
        take_line(path, file);
    fclose(file);
    return found;
}

/// The result that a function returns instead of doing anything; VK_SUCCESS: none.
static VkResult fault_of(const char *name) {
    double number = VK_SUCCESS;
    const VkResult fault = is_told(name, &number) ? (VkResult)number : VK_SUCCESS;
    device_is_lost |= fault == VK_ERROR_DEVICE_LOST;
    surface_is_lost |= fault == VK_ERROR_SURFACE_LOST_KHR;
    return device_is_lost ? VK_ERROR_DEVICE_LOST : fault;
}

static VkResult surface_fault_of(const char *name) {
    const VkResult fault = fault_of(name);
    return fault == VK_SUCCESS && surface_is_lost ? VK_ERROR_SURFACE_LOST_KHR : fault;
}

// ---------------------------------------------------------------------------------------------
// Queues

VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit(VkQueue queue, uint32_t count,
                                             const VkSubmitInfo *submits, VkFence fence) {
    const VkResult fault = fault_of("vkQueueSubmit");
    return fault ? fault : REAL(vkQueueSubmit)(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit2(VkQueue queue, uint32_t count,
                                              const VkSubmitInfo2 *submits, VkFence fence) {
    const VkResult fault = fault_of("vkQueueSubmit2");
    return fault ? fault : REAL(vkQueueSubmit2)(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL vkQueueWaitIdle(VkQueue queue) {
    const VkResult result = REAL(vkQueueWaitIdle)(queue);
    return device_is_lost ? VK_ERROR_DEVICE_LOST : result;
}

VKAPI_ATTR VkResult VKAPI_CALL vkDeviceWaitIdle(VkDevice device) {
    const VkResult result = REAL(vkDeviceWaitIdle)(device);
    return device_is_lost ? VK_ERROR_DEVICE_LOST : result;
}

/// Work that was not submitted is never signalled; waits only for submitted work.
VKAPI_ATTR VkResult VKAPI_CALL vkWaitForFences(VkDevice device, uint32_t count,
                                               const VkFence *fences, VkBool32 all,
                                               uint64_t timeout) {
    if (!fault_of("vkWaitForFences"))
        return REAL(vkWaitForFences)(device, count, fences, all, timeout);
    return vkDeviceWaitIdle(device);
}

VKAPI_ATTR VkResult VKAPI_CALL vkWaitSemaphores(VkDevice device, const VkSemaphoreWaitInfo *wait,
                                                uint64_t timeout) {
    if (!fault_of("vkWaitSemaphores"))
        return REAL(vkWaitSemaphores)(device, wait, timeout);
    return vkDeviceWaitIdle(device);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice physical,
                                              const VkDeviceCreateInfo *create,
                                              const VkAllocationCallbacks *callbacks,
                                              VkDevice *device) {
    const VkResult fault = fault_of("vkCreateDevice");
    return fault ? fault : REAL(vkCreateDevice)(physical, create, callbacks, device);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyDevice(VkDevice device,
                                           const VkAllocationCallbacks *callbacks) {
    device_is_lost = false;
    REAL(vkDestroyDevice)(device, callbacks);
}

// ---------------------------------------------------------------------------------------------
// Surfaces

VKAPI_ATTR VkResult VKAPI_CALL vkAcquireNextImageKHR(VkDevice device, VkSwapchainKHR swapchain,
                                                     uint64_t timeout, VkSemaphore semaphore,
                                                     VkFence fence, uint32_t *index) {
    const VkResult fault = surface_fault_of("vkAcquireNextImageKHR");
    if (fault < 0 || fault == VK_TIMEOUT)
        return fault;
    const VkResult result =
        REAL(vkAcquireNextImageKHR)(device, swapchain, timeout, semaphore, fence, index);
    return result ? result : fault;
}

VKAPI_ATTR VkResult VKAPI_CALL vkQueuePresentKHR(VkQueue queue, const VkPresentInfoKHR *present) {
    const VkResult fault = surface_fault_of("vkQueuePresentKHR");
    if (fault < 0)
        return fault;
    const VkResult result = REAL(vkQueuePresentKHR)(queue, present);
    return result ? result : fault;
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetPhysicalDeviceSurfaceCapabilitiesKHR(
    VkPhysicalDevice device, VkSurfaceKHR surface, VkSurfaceCapabilitiesKHR *capabilities) {
    const VkResult fault = surface_fault_of("vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    return fault ? fault
                 : REAL(vkGetPhysicalDeviceSurfaceCapabilitiesKHR)(device, surface, capabilities);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateSwapchainKHR(VkDevice device,
                                                    const VkSwapchainCreateInfoKHR *create,
                                                    const VkAllocationCallbacks *callbacks,
                                                    VkSwapchainKHR *swapchain) {
    const VkResult fault = surface_fault_of("vkCreateSwapchainKHR");
    return fault ? fault : REAL(vkCreateSwapchainKHR)(device, create, callbacks, swapchain);
}

VKAPI_ATTR void VKAPI_CALL vkDestroySurfaceKHR(VkInstance instance, VkSurfaceKHR surface,
                                               const VkAllocationCallbacks *callbacks) {
    surface_is_lost = false;
    REAL(vkDestroySurfaceKHR)(instance, surface, callbacks);
}

// ---------------------------------------------------------------------------------------------
// For the engine, which looks functions up by name

static const struct {
    const char *name;
    PFN_vkVoidFunction function;
} engine_functions[] = {
    {"vkDestroyDevice", (PFN_vkVoidFunction)vkDestroyDevice},
    {"vkDeviceWaitIdle", (PFN_vkVoidFunction)vkDeviceWaitIdle},
    {"vkGetDeviceProcAddr", (PFN_vkVoidFunction)vkGetDeviceProcAddr},
    {"vkQueueSubmit2", (PFN_vkVoidFunction)vkQueueSubmit2},
    {"vkQueueWaitIdle", (PFN_vkVoidFunction)vkQueueWaitIdle},
    {"vkWaitSemaphores", (PFN_vkVoidFunction)vkWaitSemaphores},
};

static PFN_vkVoidFunction replace(PFN_vkVoidFunction real, const char *name) {
    for (size_t i = 0; real && i < sizeof engine_functions / sizeof *engine_functions; i++)
        if (strcmp(name, engine_functions[i].name) == 0)
            return engine_functions[i].function;
    return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance,
                                                               const char *name) {
    return replace(REAL(vkGetInstanceProcAddr)(instance, name), name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char *name) {
    return replace(REAL(vkGetDeviceProcAddr)(device, name), name);
}

// ---------------------------------------------------------------------------------------------
// Monitors

static void look_at_monitors(void) {
    double number;
    if (is_told("unit", &number))
        unit = number;
    if (!is_told("scale", &number))
        return;
    scale = (float)number;
    if (on_scale)
        on_scale(scaled_window, scale, scale);
}

void glfwPollEvents(void) {
    REAL(glfwPollEvents)();
    look_at_monitors();
}

void glfwWaitEvents(void) {
    REAL(glfwWaitEvents)();
    look_at_monitors();
}

void glfwGetWindowContentScale(GLFWwindow *window, float *x, float *y) {
    REAL(glfwGetWindowContentScale)(window, x, y);
    if (scale > 0)
        *x = *y = scale;
}

void glfwGetWindowSize(GLFWwindow *window, int *width, int *height) {
    REAL(glfwGetWindowSize)(window, width, height);
    *width = (int)(*width / unit);
    *height = (int)(*height / unit);
}

void glfwGetCursorPos(GLFWwindow *window, double *x, double *y) {
    REAL(glfwGetCursorPos)(window, x, y);
    *x /= unit;
    *y /= unit;
}

static void tell_cursor(GLFWwindow *window, double x, double y) {
    on_cursor(window, x / unit, y / unit);
}

GLFWcursorposfun glfwSetCursorPosCallback(GLFWwindow *window, GLFWcursorposfun callback) {
    on_cursor = callback;
    return REAL(glfwSetCursorPosCallback)(window, tell_cursor);
}

GLFWwindowcontentscalefun glfwSetWindowContentScaleCallback(GLFWwindow *window,
                                                            GLFWwindowcontentscalefun callback) {
    scaled_window = window;
    on_scale = callback;
    return REAL(glfwSetWindowContentScaleCallback)(window, callback);
}
