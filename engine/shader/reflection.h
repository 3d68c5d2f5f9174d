#ifndef ENGINE_SHADER_REFLECTION_H
#define ENGINE_SHADER_REFLECTION_H

#include <stddef.h>
#include <stdint.h>

#include "engine/shader/shader.h"

/// Reads stage, bindings, sizes and constants of `shader` from its SPIR-V. `shader->name` must be
/// set. Free with engine_reflection_free, even after a failure. LOBE_ERROR_SHADER: invalid SPIR-V,
/// a binding outside set 0, or one of a kind that lobe does not use.
lobe_result engine_reflect(const lobe_host *host, const uint32_t *words, size_t word_count,
                           engine_shader *shader);
void engine_reflection_free(engine_shader *shader);

#endif
