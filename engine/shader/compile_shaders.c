/// The program of the build that compiles GLSL to SPIR-V, with the compiler of hot reload, inlines
/// functions and validates the result. One process compiles many shaders: most take less time than
/// the compiler needs to read GLSL's built-in functions, which it keeps.
///
/// usage: compile_shaders FOLDER LIBRARY [NAME SOURCE DEFINITIONS SUBSTITUTE OUTPUT]...
/// FOLDER and LIBRARY are those of engine_shader_folders, where an empty LIBRARY is none; NAME and
/// the next three are those of engine_shader_code. Prints one line for each shader that fails,
/// whose OUTPUT is not written, and goes on with the others.

#include <stdio.h>
#include <stdlib.h>

#include <glslang/Include/glslang_c_interface.h>

#include <lobe/file.h>

#include "engine/shader/words.h"
#include "third_party/spirv_inlining.h"

enum { NAME, SOURCE, DEFINITIONS, SUBSTITUTE, OUTPUT, FIELDS };

static void print(void *user, lobe_log_level level, const char *message) {
    (void)user;
    (void)level;
    fprintf(stderr, "%s\n", message);
}

typedef struct output {
    const lobe_host *host;
    const char *path;
    lobe_result result;
} output;

static void write_words(void *user, const uint32_t *words, size_t count) {
    output *output = user;
    output->result = lobe_file_write(output->path, words, count * sizeof *words, output->host);
}

static lobe_result inline_and_write(const lobe_host *host, const engine_shader_code *code,
                                    const engine_shader_words *words, const char *path) {
    output output = {.host = host, .path = path};
    char message[SPIRV_INLINING_MESSAGE_SIZE];
    if (!third_party_spirv_inline(words->words, words->count, write_words, &output, message))
        return lobe_host_fail(host, LOBE_ERROR_SHADER, "shader '%s': %s", code->name, message);
    return output.result;
}

static lobe_result compile(const lobe_host *host, const engine_shader_folders *folders,
                           char *const fields[FIELDS]) {
    const engine_shader_code code = {.name = fields[NAME],
                                     .source = fields[SOURCE],
                                     .definitions = fields[DEFINITIONS],
                                     .substitute = fields[SUBSTITUTE]};
    engine_shader_words words;
    lobe_result result = engine_shader_words_get(host, LOBE_LOG_ERROR, folders, &code, &words);
    if (result == LOBE_OK)
        result = inline_and_write(host, &code, &words, fields[OUTPUT]);
    engine_shader_words_free(&words);
    return result;
}

int main(int count, char **arguments) {
    if (count < 3 || (count - 3) % FIELDS != 0) {
        fprintf(stderr, "usage: compile_shaders FOLDER LIBRARY "
                        "[NAME SOURCE DEFINITIONS SUBSTITUTE OUTPUT]...\n");
        return EXIT_FAILURE;
    }
    const lobe_host host = {.write = print};
    const engine_shader_folders folders = {arguments[1], arguments[2][0] ? arguments[2] : NULL};
    int status = EXIT_SUCCESS;
    // Its built-in functions are kept as long as this counts as one who uses it.
    glslang_initialize_process();
    for (int i = 3; i < count; i += FIELDS)
        if (compile(&host, &folders, arguments + i) != LOBE_OK)
            status = EXIT_FAILURE;
    glslang_finalize_process();
    return status;
}
