#ifndef TESTS_ENGINE_SUPPORT_VULKAN_FAULTS_H
#define TESTS_ENGINE_SUPPORT_VULKAN_FAULTS_H

#include <stdbool.h>

#include <vulkan/vulkan.h>

/// A Vulkan loader for a test's devices, whose functions count created and destroyed objects and
/// fail on demand. vulkan_calls.py checks that every fallible function that lobe calls is among
/// them. Calls by the test itself go to libvulkan and do not count.
typedef struct vulkan_faults {
    int calls;             ///< so far, of those that can fail; set to 0 to count again
    int failing;           ///< which call fails; 0: none
    VkResult fault;        ///< with this
    const char *failed;    ///< its name, once it has
    const char *absent;    ///< name of a function that the loader lacks; NULL: none
    bool paused;           ///< nothing fails, and no call counts
    bool names;            ///< calls that name objects, of which there are many, can fail too
    bool timeline_unknown; ///< vkGetSemaphoreCounterValue fails
    /// Called before a pipeline is made, by the thread that makes it; the result, unless it is
    /// VK_SUCCESS, is returned instead of a pipeline. NULL: none. Not to be changed while pipelines
    /// are made.
    VkResult (*making)(void);
    // Counted in whatever thread.
    _Atomic int alive; ///< objects created and not destroyed
    _Atomic int pipelines_alive;
    _Atomic int pipelines; ///< created so far; set to 0 to restart
    _Atomic int made;      ///< so far, including those from pools; set to 0 to restart
} vulkan_faults;

extern vulkan_faults faults;

/// How often a fallible function was called in this process. There must be one of this name.
int vulkan_calls(const char *name);

/// The name of a fallible function that never failed in this process; NULL if each did.
const char *vulkan_fault_left_out(void);

#endif
