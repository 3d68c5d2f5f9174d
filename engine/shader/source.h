#ifndef ENGINE_SHADER_SOURCE_H
#define ENGINE_SHADER_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

#include "engine/shader/words.h"

/// GLSL with its includes expanded, and the files it came from.
typedef struct engine_shader_source {
    char *text; ///< allocated
    engine_source_files *files;
} engine_shader_source;

/// Reads code->source. Includes are searched beside the including file, then in each folder;
/// "filter.glsl" is code->substitute. One that is not found stays in the text: it may be switched
/// off by the preprocessor, and if not, the compiler names it. Free `source` even after a failure.
/// LOBE_ERROR_SHADER: the file itself cannot be read, includes are nested too deep.
lobe_result engine_shader_source_read(const lobe_host *host, lobe_log_level level,
                                      const engine_shader_folders *folders,
                                      const engine_shader_code *code, engine_shader_source *source);
void engine_shader_source_free(engine_shader_source *source);

bool engine_source_files_changed(const engine_source_files *files);
void engine_source_files_free(engine_source_files *files);

#endif
