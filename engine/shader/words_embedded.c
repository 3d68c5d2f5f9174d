#include "engine/shader/words.h"

const char *engine_shader_words_folder(void) {
    return NULL;
}

lobe_result engine_shader_words_get(const lobe_host *host, lobe_log_level level,
                                    const engine_shader_folders *folders,
                                    const engine_shader_code *code, engine_shader_words *words) {
    (void)host;
    (void)level;
    (void)folders;
    *words = (engine_shader_words){code->words, code->size / sizeof *code->words, NULL};
    return LOBE_OK;
}

bool engine_shader_words_are_stale(const engine_shader_words *words) {
    (void)words;
    return false;
}

void engine_shader_words_free(engine_shader_words *words) {
    *words = (engine_shader_words){0};
}
