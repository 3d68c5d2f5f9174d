#include "engine/shader/words.h"

#include <stdio.h>
#include <string.h>

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>

#include "engine/base/text.h"
#include "engine/shader/source.h"

typedef struct compilation {
    const lobe_host *host;
    lobe_log_level level;
    const engine_shader_code *code;
    glslang_shader_t *shader;
    glslang_program_t *program;
} compilation;

const char *engine_shader_words_folder(void) {
    return LOBE_SHADER_FOLDER;
}

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text), end_length = strlen(end);
    return length >= end_length && !strcmp(text + length - end_length, end);
}

static glslang_stage_t stage_of(const char *source) {
    if (ends_with(source, ".vert"))
        return GLSLANG_STAGE_VERTEX;
    return ends_with(source, ".frag") ? GLSLANG_STAGE_FRAGMENT : GLSLANG_STAGE_COMPUTE;
}

/// The compiler's list of errors begins with the cause: "ERROR: file:line: what". Lines of the
/// shader's own file come before the first #line and are counted in string 0.
static lobe_result fail(const compilation *compilation, const char *messages) {
    const char *first = strstr(messages, "ERROR: ");
    first = first ? first + strlen("ERROR: ") : messages;
    const int length = (int)strcspn(first, "\n");
    const char *name = compilation->code->name;
    if (!strncmp(first, "0:", 2))
        lobe_host_log(compilation->host, compilation->level, "shader '%s': %s:%.*s", name,
                      compilation->code->source, length - 2, first + 2);
    else
        lobe_host_log(compilation->host, compilation->level, "shader '%s': %.*s", name, length,
                      first);
    return LOBE_ERROR_SHADER;
}

/// "AOV FAST" as "#define AOV\n#define FAST\n"; the caller frees it with lobe_release. NULL if out
/// of memory.
static char *preamble_of(const lobe_allocator *allocator, const char *definitions) {
    engine_text_builder text = {.bytes.allocator = allocator};
    for (const char *name = definitions; *name;) {
        const int length = (int)strcspn(name, " ");
        if (length > 0)
            engine_text_add(&text, "#define %.*s\n", length, name);
        name += length;
        name += strspn(name, " ");
    }
    return engine_text_finish(&text);
}

static lobe_result parse(compilation *compilation, const char *text, const char *preamble) {
    const glslang_input_t input = {
        .language = GLSLANG_SOURCE_GLSL,
        .stage = stage_of(compilation->code->source),
        .client = GLSLANG_CLIENT_VULKAN,
        .client_version = GLSLANG_TARGET_VULKAN_1_3,
        .target_language = GLSLANG_TARGET_SPV,
        .target_language_version = GLSLANG_TARGET_SPV_1_6,
        .code = text,
        .default_version = 100,
        .default_profile = GLSLANG_NO_PROFILE,
        .messages = GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT,
        .resource = glslang_default_resource(),
    };
    compilation->shader = glslang_shader_create(&input);
    if (!compilation->shader)
        return fail(compilation, "the compiler refuses to start");
    glslang_shader_set_preamble(compilation->shader, preamble);
    if (!glslang_shader_preprocess(compilation->shader, &input) ||
        !glslang_shader_parse(compilation->shader, &input))
        return fail(compilation, glslang_shader_get_info_log(compilation->shader));
    return LOBE_OK;
}

static lobe_result link_program(compilation *compilation) {
    compilation->program = glslang_program_create();
    glslang_program_add_shader(compilation->program, compilation->shader);
    if (!glslang_program_link(compilation->program,
                              GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT))
        return fail(compilation, glslang_program_get_info_log(compilation->program));
    // By default it also runs a validator, whose messages it keeps to itself.
    glslang_spv_options_t options = {.disable_optimizer = true};
    glslang_program_SPIRV_generate_with_options(compilation->program,
                                                stage_of(compilation->code->source), &options);
    return LOBE_OK;
}

static lobe_result copy_words(const compilation *compilation, engine_shader_words *words) {
    const size_t count = glslang_program_SPIRV_get_size(compilation->program);
    uint32_t *copy = lobe_allocate(lobe_host_allocator(compilation->host), count, sizeof *copy);
    if (!copy)
        return lobe_host_fail(compilation->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "shader '%s': out of memory", compilation->code->name);
    glslang_program_SPIRV_get(compilation->program, copy);
    words->words = copy;
    words->count = count;
    return LOBE_OK;
}

static lobe_result compile(compilation *compilation, const char *text, engine_shader_words *words) {
    char *preamble =
        preamble_of(lobe_host_allocator(compilation->host), compilation->code->definitions);
    if (!preamble)
        return lobe_host_fail(compilation->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "shader '%s': out of memory", compilation->code->name);
    // Reference-counted, so it is safe if the host uses the compiler as well.
    glslang_initialize_process();
    lobe_result result = parse(compilation, text, preamble);
    if (result == LOBE_OK)
        result = link_program(compilation);
    if (result == LOBE_OK)
        result = copy_words(compilation, words);
    if (compilation->program)
        glslang_program_delete(compilation->program);
    if (compilation->shader)
        glslang_shader_delete(compilation->shader);
    glslang_finalize_process();
    lobe_release(preamble);
    return result;
}

lobe_result engine_shader_words_get(const lobe_host *host, lobe_log_level level,
                                    const engine_shader_folders *folders,
                                    const engine_shader_code *code, engine_shader_words *words) {
    *words = (engine_shader_words){0};
    compilation compilation = {.host = host, .level = level, .code = code};
    engine_shader_source source;
    lobe_result result = engine_shader_source_read(host, level, folders, code, &source);
    if (result == LOBE_OK)
        result = compile(&compilation, source.text, words);
    words->files = source.files;
    source.files = NULL;
    engine_shader_source_free(&source);
    return result;
}

bool engine_shader_words_are_stale(const engine_shader_words *words) {
    return engine_source_files_changed(words->files);
}

void engine_shader_words_free(engine_shader_words *words) {
    lobe_release((void *)words->words);
    engine_source_files_free(words->files);
    *words = (engine_shader_words){0};
}
