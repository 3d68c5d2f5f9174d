#include "tests/engine/support/cmocka_all.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glslang/Include/glslang_c_interface.h>

#include "engine/device/device.h"
#include "engine/shader/reflection.h"
#include "engine/shader/shaders.h"
#include "engine/shader/words.h"
#include "tests/engine/support/log_recorder.h"

static const char *const file_names[] = {"main.comp", "lib/value.glsl", "filters/plain.glsl"};

static const engine_shader_code codes[] = {
    {.name = "absent.comp", .source = "absent.comp", .definitions = "", .substitute = ""},
    {.name = "main_plain.comp",
     .source = "main.comp",
     .definitions = "",
     .substitute = "filters/plain.glsl"},
    {.name = "main_plain_wide.comp",
     .source = "main.comp",
     .definitions = "WIDE EXTRA",
     .substitute = "filters/plain.glsl"},
};

static log_recorder recorder;
static lobe_device *device;
static char folder[] = "/tmp/lobe_test_XXXXXX";

static void path_of(const char *name, char path[128]) {
    snprintf(path, 128, "%s/%s", folder, name);
}

/// Also advances the modification time, for file systems with coarse timestamps.
static void write_file(const char *name, const char *text) {
    static int writes = 0;
    char path[128];
    path_of(name, path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
    struct timespec times[2] = {{.tv_nsec = UTIME_OMIT}, {.tv_sec = 1000000000 + ++writes}};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

static const char main_text[] = "#version 460\n"
                                "#extension GL_GOOGLE_include_directive : require\n"
                                "#include \"lib/value.glsl\"\n"
                                "#include \"filter.glsl\"\n"
                                "#ifdef WIDE\n"
                                "layout(local_size_x = 32) in;\n"
                                "#else\n"
                                "layout(local_size_x = 4) in;\n"
                                "#endif\n"
                                "layout(set = 0, binding = 0) buffer Target { float target; };\n"
                                "void main() { target = value() + filtered(); }\n";

static int make_sources(void **state) {
    (void)state;
    char path[128];
    strcpy(folder + strlen(folder) - 6, "XXXXXX");
    log_recorder_start(&recorder);
    if (!mkdtemp(folder))
        return 1;
    path_of("lib", path);
    mkdir(path, 0700);
    path_of("filters", path);
    mkdir(path, 0700);
    write_file("main.comp", main_text);
    write_file("lib/value.glsl", "float value() { return 1; }\n");
    write_file("filters/plain.glsl", "float filtered() { return 2; }\n");
    if (lobe_device_create(&(lobe_device_parameters){.validation = true, .host = &recorder.host},
                           &device))
        return 1;
    return engine_shaders_add(device, codes, sizeof codes / sizeof *codes, folder) != LOBE_OK;
}

static int remove_sources(void **state) {
    (void)state;
    char path[128];
    lobe_device_destroy(&device);
    for (size_t i = 0; i < sizeof file_names / sizeof *file_names; i++) {
        path_of(file_names[i], path);
        unlink(path);
    }
    path_of("lib", path);
    rmdir(path);
    path_of("filters", path);
    rmdir(path);
    return rmdir(folder);
}

static const engine_shader *find(const char *name) {
    const engine_shader *shader = NULL;
    assert_int_equal(engine_shader_find(device, name, &shader), LOBE_OK);
    return shader;
}

static void includes_definitions_and_substitutes_are_resolved(void **state) {
    (void)state;
    assert_int_equal(find("main_plain.comp")->local_size[0], 4);
    assert_int_equal(find("main_plain_wide.comp")->local_size[0], 32);
    assert_int_equal(recorder.errors, 0);
}

static void unchanged_source_is_not_compiled_again(void **state) {
    (void)state;
    const engine_shader *shader = find("main_plain.comp");
    assert_ptr_equal(find("main_plain.comp"), shader);
}

static void every_file_that_was_read_is_watched(void **state) {
    (void)state;
    const char *const texts[] = {main_text, "float value() { return 3; }\n",
                                 "float filtered() { return 4; }\n"};
    const engine_shader *shader = find("main_plain.comp");
    for (size_t i = 0; i < sizeof file_names / sizeof *file_names; i++) {
        write_file(file_names[i], texts[i]);
        assert_int_equal(engine_shaders_stale(device), 1);
        const engine_shader *changed = find("main_plain.comp");
        assert_int_not_equal(changed->version, shader->version);
        assert_int_equal(engine_shaders_stale(device), 0);
        assert_ptr_equal(find("main_plain.comp"), changed);
        shader = changed;
    }
}

static void mistake_is_a_warning_with_file_and_line(void **state) {
    (void)state;
    const engine_shader *good = find("main_plain.comp");
    write_file("lib/value.glsl", "// one\n// two\nfloat value() { return nothing; }\n");
    assert_ptr_equal(find("main_plain.comp"), good);
    assert_int_equal(recorder.warnings, 1);
    assert_int_equal(recorder.errors, 0);
    assert_non_null(strstr(recorder.last_warning, "lib/value.glsl:3:"));
    assert_non_null(strstr(recorder.last_warning, "nothing"));
    // Reported once, until the file changes again.
    assert_ptr_equal(find("main_plain.comp"), good);
    assert_int_equal(recorder.warnings, 1);
    write_file("lib/value.glsl", "float value() { return 5; }\n");
    assert_ptr_not_equal(find("main_plain.comp"), good);
}

static void lines_after_an_include_are_counted_in_the_file_itself(void **state) {
    (void)state;
    char text[sizeof main_text + 32];
    snprintf(text, sizeof text, "%sint broken = ;\n", main_text);
    find("main_plain.comp");
    write_file("main.comp", text);
    find("main_plain.comp");
    assert_non_null(strstr(recorder.last_warning, "main.comp:12:"));
}

static void mistake_at_the_first_lookup_is_an_error(void **state) {
    (void)state;
    const engine_shader *shader = NULL;
    write_file("main.comp", "#version 460\nvoid main() { nothing(); }\n");
    assert_int_equal(engine_shader_find(device, "main_plain.comp", &shader), LOBE_ERROR_SHADER);
    assert_null(shader);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "main.comp:2:"));
}

static void missing_source_is_an_error_that_names_it(void **state) {
    (void)state;
    const engine_shader *shader = NULL;
    assert_int_equal(engine_shader_find(device, "absent.comp", &shader), LOBE_ERROR_SHADER);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "absent.comp"));
}

static void missing_include_is_named(void **state) {
    (void)state;
    const engine_shader *shader = NULL;
    write_file("lib/value.glsl", "#include \"lib/nowhere.glsl\"\n");
    assert_int_equal(engine_shader_find(device, "main_plain.comp", &shader), LOBE_ERROR_SHADER);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "nowhere.glsl"));
}

static void files_that_include_each_other_end(void **state) {
    (void)state;
    const engine_shader *shader = NULL;
    write_file("lib/value.glsl", "#include \"lib/value.glsl\"\n");
    assert_int_equal(engine_shader_find(device, "main_plain.comp", &shader), LOBE_ERROR_SHADER);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "nested too deep"));
}

#ifndef __SANITIZE_ADDRESS__ // half a minute there, for what other cases run as well
/// Whether its source is compiled with more macros, too.
static bool is_between(const engine_shader_code *code) {
    for (size_t i = 0; i < engine_embedded_shaders_count; i++) {
        const engine_shader_code *other = &engine_embedded_shaders[i];
        if (strcmp(code->source, other->source) == 0 &&
            strcmp(code->substitute, other->substitute) == 0 &&
            strlen(code->definitions) < strlen(other->definitions))
            return code->definitions[0] != '\0';
    }
    return false;
}

/// The run-time compiler and the build generate the same code for the shaders of the library, of
/// each source without macros and with all of them.
static void library_shaders_are_as_the_build_made_them(void **state) {
    (void)state;
    for (size_t i = 0; i < engine_embedded_shaders_count; i++) {
        const engine_shader_code *code = &engine_embedded_shaders[i];
        if (is_between(code))
            continue;
        const engine_shader *shader = find(code->name);
        engine_shader embedded = {.name = code->name};
        assert_int_equal(engine_reflect(&recorder.host, code->words, code->size / 4, &embedded),
                         LOBE_OK);
        assert_int_equal(shader->stage, embedded.stage);
        assert_int_equal(shader->binding_count, embedded.binding_count);
        // The build removes those that nothing reads.
        if (embedded.push_constant_size > 0)
            assert_int_equal(shader->push_constant_size, embedded.push_constant_size);
        assert_int_equal(shader->output_locations, embedded.output_locations);
        assert_memory_equal(shader->local_size, embedded.local_size, sizeof embedded.local_size);
        for (size_t j = 0; j < embedded.binding_count; j++)
            assert_string_equal(shader->bindings[j].name, embedded.bindings[j].name);
        engine_reflection_free(&embedded);
    }
    assert_string_equal(engine_shader_words_folder(), LOBE_SHADER_FOLDER);
}
#endif

#define WITH_SOURCES(test) cmocka_unit_test_setup_teardown(test, make_sources, remove_sources)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_SOURCES(includes_definitions_and_substitutes_are_resolved),
        WITH_SOURCES(unchanged_source_is_not_compiled_again),
        WITH_SOURCES(every_file_that_was_read_is_watched),
        WITH_SOURCES(mistake_is_a_warning_with_file_and_line),
        WITH_SOURCES(lines_after_an_include_are_counted_in_the_file_itself),
        WITH_SOURCES(mistake_at_the_first_lookup_is_an_error),
        WITH_SOURCES(missing_source_is_an_error_that_names_it),
        WITH_SOURCES(missing_include_is_named),
        WITH_SOURCES(files_that_include_each_other_end),
#ifndef __SANITIZE_ADDRESS__
        WITH_SOURCES(library_shaders_are_as_the_build_made_them),
#endif
    };
    // The compiler builds its symbol tables for the first user and drops them with the last:
    // without this one, every compilation would build them again, for most of this test's time.
    glslang_initialize_process();
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    glslang_finalize_process();
    return failures;
}
