#ifndef THIRD_PARTY_SPIRV_TOOLS_H
#define THIRD_PARTY_SPIRV_TOOLS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SPIRV_MESSAGE_SIZE 200

typedef struct spirv_constant {
    uint32_t id;
    uint32_t bits; ///< of a number of at most 32 bits; of a boolean, 0 is false
} spirv_constant;

typedef struct spirv_source {
    const uint32_t *words;
    size_t count;
    const spirv_constant *constants; ///< the last value of an id counts; unknown ids are ignored
    size_t constant_count;
    /// Takes the result, which is freed afterwards. Must not throw.
    void (*take)(void *user, const uint32_t *words, size_t count);
    void *user;
} spirv_source;

/// Replaces the specialisation constants of a SPIR-V module by these values, others by their
/// defaults, and removes the code that becomes unreachable. False: `message` says why (damaged, out
/// of memory), and nothing was taken.
bool third_party_spirv_specialise(const spirv_source *source, char message[SPIRV_MESSAGE_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
