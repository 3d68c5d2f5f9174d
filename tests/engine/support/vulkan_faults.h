#ifndef TESTS_ENGINE_SUPPORT_VULKAN_FAULTS_H
#define TESTS_ENGINE_SUPPORT_VULKAN_FAULTS_H

#include <stdbool.h>

#include <vulkan/vulkan.h>

/// Functions of Vulkan that stand before those of the loader in a program that is linked to them:
/// each that can fail does so when it is told to, and what is made and destroyed is counted. A test
/// (vulkan_calls.py) sees to it that all are here that lobe calls.
typedef struct vulkan_faults {
    int calls;          ///< so far, of those that can fail; set to 0 to count anew
    int failing;        ///< the one that fails; 0: none
    VkResult fault;     ///< with this
    const char *failed; ///< its name, once it has
    bool paused;        ///< while the host calls: nothing fails, and no call counts
    bool names;         ///< calls that name objects, of which there are many, can fail too
    // Counted in whatever thread.
    _Atomic int alive;     ///< objects made and not destroyed
    _Atomic int pipelines; ///< made so far; set to 0 to count anew
    _Atomic int made;      ///< so far, taken from pools included; set to 0 to count anew
} vulkan_faults;

extern vulkan_faults faults;

/// The name of a function that can fail and never did in this process; NULL: each did.
const char *vulkan_fault_left_out(void);

#endif
