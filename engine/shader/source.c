#include "engine/shader/source.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include <lobe/file.h>

#include "engine/base/text.h"

/// Deep enough for any sensible nesting; stops files that include each other.
#define MAXIMUM_DEPTH 16

typedef struct source_file {
    char *path;
    struct timespec changed; ///< all zero: the file did not exist
    off_t size;
} source_file;

struct engine_source_files {
    source_file *files;
    size_t count;
};

typedef struct expansion {
    const lobe_host *host;
    lobe_log_level level;
    const engine_shader_folders *folders;
    const engine_shader_code *code;
    engine_source_files *files;
    engine_text_builder output;
} expansion;

// ---------------------------------------------------------------------------------------------
// Files and their times

static source_file look_at(char *path) {
    struct stat status;
    source_file file = {.path = path};
    if (stat(path, &status) == 0) {
        file.changed = status.st_mtim;
        file.size = status.st_size;
    }
    return file;
}

static lobe_result fail_memory(const expansion *expansion) {
    return lobe_host_fail(expansion->host, LOBE_ERROR_OUT_OF_MEMORY, "shader '%s': out of memory",
                          expansion->code->name);
}

static lobe_result remember(expansion *expansion, const char *path) {
    engine_source_files *files = expansion->files;
    source_file *grown = lobe_reallocate(lobe_host_allocator(expansion->host), files->files,
                                         files->count + 1, sizeof *grown);
    if (!grown)
        return fail_memory(expansion);
    files->files = grown;
    char *copy = lobe_copy_text(lobe_host_allocator(expansion->host), path);
    if (!copy)
        return fail_memory(expansion);
    grown[files->count++] = look_at(copy);
    return LOBE_OK;
}

bool engine_source_files_changed(const engine_source_files *files) {
    for (size_t i = 0; files && i < files->count; i++) {
        const source_file *then = &files->files[i], now = look_at(then->path);
        if (now.size != then->size || now.changed.tv_sec != then->changed.tv_sec ||
            now.changed.tv_nsec != then->changed.tv_nsec)
            return true;
    }
    return false;
}

void engine_source_files_free(engine_source_files *files) {
    for (size_t i = 0; files && i < files->count; i++)
        lobe_release(files->files[i].path);
    if (files)
        lobe_release(files->files);
    lobe_release(files);
}

// ---------------------------------------------------------------------------------------------
// Expanding includes

/// Copies the name in `#include "name"`; false if the line is not an include.
static bool parse_include(const char *line, size_t length, char name[PATH_MAX]) {
    char text[PATH_MAX];
    const size_t blanks = strspn(line, " \t");
    if (blanks >= length || line[blanks] != '#')
        return false;
    snprintf(text, sizeof text, "%.*s", (int)length, line);
    return sscanf(text, " # include \"%[^\"\n]\"", name) == 1;
}

/// Whether the first `length` characters of `folder` and `name` make the path of a file.
static bool names_file(const char *folder, size_t length, const char *name, char path[PATH_MAX]) {
    struct stat status;
    const int size = snprintf(path, PATH_MAX, "%.*s%s", (int)length, folder, name);
    return size < PATH_MAX && stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/// Finds the file that an include refers to.
static bool resolve(const expansion *expansion, const char *includer, const char *name,
                    char path[PATH_MAX]) {
    if (!strcmp(name, "filter.glsl") && expansion->code->substitute[0])
        name = expansion->code->substitute;
    const char *slash = strrchr(includer, '/');
    if (names_file(includer, slash ? (size_t)(slash + 1 - includer) : 0, name, path))
        return true;
    const char *const folders[] = {expansion->folders->own, expansion->folders->library};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        char in_folder[PATH_MAX];
        if (folders[i] && snprintf(in_folder, sizeof in_folder, "%s/", folders[i]) < PATH_MAX &&
            names_file(in_folder, strlen(in_folder), name, path))
            return true;
    }
    return false;
}

static lobe_result expand_file(expansion *expansion, const char *path, int depth);

static lobe_result expand_include(expansion *expansion, const char *path, int depth,
                                  const char *included, unsigned number) {
    if (depth == MAXIMUM_DEPTH) {
        lobe_host_log(expansion->host, expansion->level, "shader '%s': %s:%u: nested too deep",
                      expansion->code->name, path, number);
        return LOBE_ERROR_SHADER;
    }
    engine_text_add(&expansion->output, "#line 1 \"%s\"\n", included);
    const lobe_result result = expand_file(expansion, included, depth + 1);
    engine_text_add(&expansion->output, "#line %u \"%s\"\n", number + 1, path);
    return result;
}

/// Adds whole lines, the last of which may lack its end.
static void add_lines(expansion *expansion, const char *start, const char *end) {
    if (start < end)
        engine_text_add(&expansion->output, "%.*s%s", (int)(end - start), start,
                        end[-1] == '\n' ? "" : "\n");
}

/// `text` ends in a zero byte. Lines between two includes are added at once.
static lobe_result expand_text(expansion *expansion, const char *path, int depth, const char *text,
                               size_t size) {
    lobe_result result = LOBE_OK;
    const char *end = text + size, *unwritten = text, *next;
    unsigned number = 1;
    for (const char *line = text; result == LOBE_OK && line < end; line = next, number++) {
        char name[PATH_MAX], included[PATH_MAX];
        const char *line_end = memchr(line, '\n', (size_t)(end - line));
        next = line_end ? line_end + 1 : end;
        if (!parse_include(line, (size_t)(next - line), name) ||
            !resolve(expansion, path, name, included))
            continue;
        add_lines(expansion, unwritten, line);
        result = expand_include(expansion, path, depth, included, number);
        unwritten = next;
    }
    add_lines(expansion, unwritten, end);
    return result;
}

static lobe_result expand_file(expansion *expansion, const char *path, int depth) {
    const lobe_host silent = {.allocator = lobe_host_allocator(expansion->host)};
    uint8_t *data = NULL;
    size_t size = 0;
    lobe_result result = remember(expansion, path);
    if (result != LOBE_OK)
        return result;
    result = lobe_file_read(path, NULL, &silent, &data, &size);
    if (result != LOBE_OK) {
        lobe_host_log(expansion->host, expansion->level, "shader '%s': the source %s: %s",
                      expansion->code->name, path, lobe_result_message(result));
        return LOBE_ERROR_SHADER;
    }
    result = expand_text(expansion, path, depth, (const char *)data, size);
    lobe_release(data);
    return result;
}

lobe_result engine_shader_source_read(const lobe_host *host, lobe_log_level level,
                                      const engine_shader_folders *folders,
                                      const engine_shader_code *code,
                                      engine_shader_source *source) {
    const lobe_allocator *allocator = lobe_host_allocator(host);
    *source = (engine_shader_source){.files = lobe_allocate(allocator, 1, sizeof *source->files)};
    expansion expansion = {host, level,         folders,
                           code, source->files, {.bytes.allocator = allocator}};
    if (!source->files)
        return fail_memory(&expansion);
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", folders->own ? folders->own : ".", code->source);
    lobe_result result = expand_file(&expansion, path, 0);
    source->text = engine_text_finish(&expansion.output);
    if (!source->text && result == LOBE_OK)
        result = fail_memory(&expansion);
    return result;
}

void engine_shader_source_free(engine_shader_source *source) {
    lobe_release(source->text);
    engine_source_files_free(source->files);
    *source = (engine_shader_source){0};
}
