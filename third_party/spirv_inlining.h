#ifndef THIRD_PARTY_SPIRV_INLINING_H
#define THIRD_PARTY_SPIRV_INLINING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SPIRV_INLINING_MESSAGE_SIZE 500

/// Inlines the functions of a SPIR-V module for Vulkan 1.3, except those that return before their
/// last block, removes what is then unused, and validates the result. Bindings and specialisation
/// constants stay, also those that no code uses. `take` gets the result, which is freed afterwards;
/// it must not throw. False: `message` says why (invalid, out of memory), and nothing was taken.
bool third_party_spirv_inline(const uint32_t *words, size_t count,
                              void (*take)(void *user, const uint32_t *words, size_t count),
                              void *user, char message[SPIRV_INLINING_MESSAGE_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
