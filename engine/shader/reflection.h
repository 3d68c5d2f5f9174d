#ifndef ENGINE_SHADER_REFLECTION_H
#define ENGINE_SHADER_REFLECTION_H

#include <stddef.h>
#include <stdint.h>

#include "engine/shader/shader.h"

/// Fills all of `shader` that follows from its SPIR-V words: stage, bindings, sizes, constants.
/// `shader->name` must be set. What it allocates is freed by engine_reflection_free, after a
/// failure too. LOBE_ERROR_SHADER: the words are no SPIR-V, a binding is outside set 0 or of a kind
/// that lobe does not use.
lobe_result engine_reflect(const lobe_host *host, const uint32_t *words, size_t word_count,
                           engine_shader *shader);
void engine_reflection_free(engine_shader *shader);

#endif
