#ifndef ENGINE_SHADER_SOURCE_H
#define ENGINE_SHADER_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

#include "engine/shader/words.h"

/// GLSL with its includes put in place, as one text; and the files it came from.
typedef struct engine_shader_source {
    char *text; ///< allocated
    engine_source_files *files;
} engine_shader_source;

/// Reads code->source. An include is looked for beside the file that includes it, then in each of
/// the folders; "filter.glsl" is code->substitute. One that is not found stays in the text: it may
/// be switched off, and if not, the compiler names it. `source` is to be freed after a failure too.
/// LOBE_ERROR_SHADER: the file itself cannot be read, includes are nested too deep.
lobe_result engine_shader_source_read(const lobe_host *host, lobe_log_level level,
                                      const engine_shader_folders *folders,
                                      const engine_shader_code *code, engine_shader_source *source);
void engine_shader_source_free(engine_shader_source *source);

bool engine_source_files_changed(const engine_source_files *files);
void engine_source_files_free(engine_source_files *files);

#endif
