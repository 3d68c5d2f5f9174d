#ifndef ENGINE_SHADER_WORDS_H
#define ENGINE_SHADER_WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/shader/shader.h"

/// Where a shader's SPIR-V comes from. The build chooses one of two implementations: the embedded
/// words, or (hot reload) the compiler.

/// The files that words were compiled from, with the times of their last change. All zero: none.
typedef struct engine_source_files engine_source_files;

typedef struct engine_shader_words {
    const uint32_t *words;
    size_t count;
    engine_source_files *files; ///< NULL if the words are embedded
} engine_shader_words;

/// Where sources are searched: the table's own folder, then the library's.
typedef struct engine_shader_folders {
    const char *own, *library;
} engine_shader_folders;

/// Default folder of the library's shader sources; NULL if none are needed.
const char *engine_shader_words_folder(void);

/// Gives the words of a shader; free them with engine_shader_words_free. If its sources do not
/// compile or are missing, one line is logged with `level` and `words->words` is NULL, but
/// `words->files` may list what was read. LOBE_ERROR_SHADER, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result engine_shader_words_get(const lobe_host *host, lobe_log_level level,
                                    const engine_shader_folders *folders,
                                    const engine_shader_code *code, engine_shader_words *words);
/// Whether a file that the words were compiled from has changed since.
bool engine_shader_words_are_stale(const engine_shader_words *words);
void engine_shader_words_free(engine_shader_words *words);

#endif
