#ifndef TESTS_VULKAN_FAULTS_H
#define TESTS_VULKAN_FAULTS_H

#include <vulkan/vulkan.h>

/// Functions of Vulkan that stand before those of the loader in a program that is linked to them:
/// each that can fail does so when it is told to, and what is made and destroyed is counted.
typedef struct vulkan_faults {
    int calls;          ///< so far, of those that can fail; set to 0 to count anew
    int failing;        ///< the one that fails; 0: none
    VkResult fault;     ///< with this
    const char *failed; ///< its name, once it has
    int alive;          ///< objects made and not destroyed
    int pipelines;      ///< made so far; set to 0 to count anew
    int made;           ///< so far, taken from pools included; set to 0 to count anew
} vulkan_faults;

extern vulkan_faults faults;

#endif
