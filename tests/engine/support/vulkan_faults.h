#ifndef TESTS_ENGINE_SUPPORT_VULKAN_FAULTS_H
#define TESTS_ENGINE_SUPPORT_VULKAN_FAULTS_H

#include <stdbool.h>

#include <vulkan/vulkan.h>

/// A Vulkan loader for the devices of a test program, whose functions count what is made and
/// destroyed and fail when they are to. vulkan_calls.py checks that each function that lobe calls
/// and that can fail is among them. Calls by the test itself go to libvulkan and do not count.
typedef struct vulkan_faults {
    int calls;             ///< so far, of those that can fail; set to 0 to count anew
    int failing;           ///< which call fails; 0: none
    VkResult fault;        ///< with this
    const char *failed;    ///< its name, once it has
    const char *absent;    ///< name of a function that the loader lacks; NULL: none
    bool paused;           ///< nothing fails, and no call counts
    bool names;            ///< calls that name objects, of which there are many, can fail too
    bool timeline_unknown; ///< vkGetSemaphoreCounterValue fails
    // Counted in whatever thread.
    _Atomic int alive; ///< objects made and not destroyed
    _Atomic int pipelines_alive;
    _Atomic int pipelines; ///< made so far; set to 0 to count anew
    _Atomic int made;      ///< so far, taken from pools included; set to 0 to count anew
} vulkan_faults;

extern vulkan_faults faults;

/// The name of a function that can fail and never did in this process; NULL: each did.
const char *vulkan_fault_left_out(void);

#endif
