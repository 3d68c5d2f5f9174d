// Shaders with values for their specialisation constants.

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include <spirv-tools/libspirv.h>

#include "engine/device/device.h"
#include "engine/pipeline/module.h"
#include "engine/shader/shaders.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/test_shaders.h"
#include "third_party/spirv_tools.h"

// Numbers of the SPIR-V specification.
enum {
    OP_CONSTANT = 43,
    OP_SPECIALISATION_TRUE = 48,
    OP_SPECIALISATION_FALSE = 49,
    OP_SPECIALISATION_OPERATION = 52,
    OP_DECORATE = 71,
    OP_IMAGE_SAMPLE_EXPLICIT_LOD = 88,
    OP_LOOP_MERGE = 246,
    OP_BRANCH_CONDITIONAL = 250,
    DECORATION_SPEC_ID = 1,
    HEADER_WORDS = 5,
};

static log_recorder recorder;
static lobe_device *device;

static int open_device(void **state) {
    (void)state;
    log_recorder_start(&recorder);
    return open_device_with_test_shaders(&recorder.host, NULL, &device) != LOBE_OK;
}

static int close_device(void **state) {
    (void)state;
    const uint64_t mistakes = lobe_device_validation_count(device);
    lobe_device_destroy(&device);
    return mistakes != 0;
}

static const engine_shader *find(const char *name) {
    const engine_shader *shader;
    assert_int_equal(engine_shader_find(device, name, &shader), LOBE_OK);
    return shader;
}

typedef struct content {
    size_t words, spec_ids, samples, loops, branches;
} content;

static void count(void *user, const uint32_t *words, size_t length) {
    content *found = user;
    found->words = length;
    for (size_t i = HEADER_WORDS; i < length; i += words[i] >> 16) {
        const uint32_t operation = words[i] & 0xffff;
        found->spec_ids += operation == OP_DECORATE && words[i + 2] == DECORATION_SPEC_ID;
        found->samples += operation == OP_IMAGE_SAMPLE_EXPLICIT_LOD;
        found->loops += operation == OP_LOOP_MERGE;
        found->branches += operation == OP_BRANCH_CONDITIONAL;
    }
}

static content specialised(const engine_shader *shader, const spirv_constant *constants,
                           size_t constant_count) {
    content found = {0};
    const spirv_source source = {
        shader->words, shader->word_count, constants, constant_count, count, &found};
    char message[SPIRV_MESSAGE_SIZE];
    assert_true(third_party_spirv_specialise(&source, message));
    return found;
}

static void constants_become_values(void **state) {
    (void)state;
    const engine_shader *shader = find("reflection.comp");
    content whole = {0};
    count(&whole, shader->words, shader->word_count);
    assert_int_equal(whole.spec_ids, 2);
    const spirv_constant both[] = {{3, 5}, {7, 1}};
    assert_int_equal(specialised(shader, both, 2).spec_ids, 0);
    // Others have their defaults, and identifiers that the shader lacks do not matter.
    const spirv_constant other[] = {{99, 5}};
    assert_int_equal(specialised(shader, other, 1).spec_ids, 0);
}

static void unreachable_code_is_removed(void **state) {
    (void)state;
    const engine_shader *shader = find("reflection.comp");
    const spirv_constant doubled[] = {{3, 5}, {7, 1}}, plain[] = {{3, 5}, {7, 0}};
    const content with = specialised(shader, doubled, 2), without = specialised(shader, plain, 2);
    assert_true(with.samples > 0 && with.loops == 1);
    // Only the loop's own condition remains.
    assert_int_equal(with.branches, 1);
    assert_int_equal(without.branches, 1);
    assert_true(without.words < with.words);
}

typedef struct numbers {
    size_t operations, count;
    uint32_t values[64];
} numbers;

static void collect(void *user, const uint32_t *words, size_t length) {
    numbers *found = user;
    for (size_t i = HEADER_WORDS; i < length; i += words[i] >> 16) {
        const uint32_t operation = words[i] & 0xffff;
        found->operations += operation == OP_SPECIALISATION_OPERATION;
        if (operation == OP_CONSTANT && found->count < 64)
            found->values[found->count++] = words[i + 3];
    }
}

static bool has_number(const numbers *found, uint32_t value) {
    for (size_t i = 0; i < found->count; i++)
        if (found->values[i] == value)
            return true;
    return false;
}

static void check_operations(uint32_t a, uint32_t b, bool c) {
    const engine_shader *shader = find("constant_operations.comp");
    const spirv_constant constants[] = {{0, a}, {1, b}, {2, c}};
    numbers found = {0};
    const spirv_source source = {shader->words, shader->word_count, constants, 3, collect, &found};
    char message[SPIRV_MESSAGE_SIZE];
    assert_true(third_party_spirv_specialise(&source, message));
    assert_int_equal(found.operations, 0);
    const uint32_t results[] = {a + b, a - b, a * b, a / b, a & b};
    for (int i = 0; i < 5; i++)
        assert_true(has_number(&found, results[i]));
    const bool choices[] = {a > b,  a >= b,      a < b,       a <= b, a == b,
                            a != b, a == b && c, a == b || c, !c};
    for (uint32_t i = 0; i < 9; i++) {
        assert_true(has_number(&found, (choices[i] ? 1001 : 2001) + i));
        assert_false(has_number(&found, (choices[i] ? 2001 : 1001) + i));
    }
}

static void operations_on_constants_are_computed(void **state) {
    (void)state;
    check_operations(3000000019, 77777, false);
    check_operations(77777, 3000000019, true);
    check_operations(50021, 50021, false);
    check_operations(50021, 50021, true);
}

// ---------------------------------------------------------------------------------------------
// All shaders of the library

typedef struct validation {
    const char *shader;
    spv_context context;
} validation;

static void validate(void *user, const uint32_t *words, size_t length) {
    const validation *checked = user;
    spv_diagnostic diagnostic = NULL;
    if (spvValidateBinary(checked->context, words, length, &diagnostic) != SPV_SUCCESS)
        fail_msg("%s: %s", checked->shader, diagnostic ? diagnostic->error : "invalid");
}

static bool is_local_size(const engine_shader *shader, uint32_t id) {
    return id == shader->local_size_ids[0] || id == shader->local_size_ids[1] ||
           id == shader->local_size_ids[2];
}

/// Whether the shader says so of a constant, by its number.
static bool is_boolean(const engine_shader *shader, uint32_t number) {
    const uint32_t *words = shader->words;
    uint32_t id = 0;
    for (size_t i = HEADER_WORDS; i < shader->word_count; i += words[i] >> 16) {
        const uint32_t operation = words[i] & 0xffff;
        if (operation == OP_DECORATE && words[i + 2] == DECORATION_SPEC_ID &&
            words[i + 3] == number)
            id = words[i + 1];
        if (operation == OP_SPECIALISATION_TRUE || operation == OP_SPECIALISATION_FALSE)
            if (words[i + 2] == id)
                return true;
    }
    return false;
}

/// By chance. Numbers are 1 to 4, for some are lengths of arrays; groups are 4 x 4 x 4.
static uint32_t some_value(const engine_shader *shader, uint32_t number, uint32_t *seed) {
    *seed = *seed * 1664525 + 1013904223;
    if (is_local_size(shader, number))
        return 4;
    return is_boolean(shader, number) ? *seed >> 31 : 1 + (*seed >> 30);
}

static void check_validity(const engine_shader *shader, validation *checked, uint32_t *seed) {
    spirv_constant constants[128];
    assert_true(shader->specialisation_count <= 128);
    for (size_t i = 0; i < shader->specialisation_count; i++) {
        const uint32_t number = shader->specialisation_ids[i];
        constants[i] = (spirv_constant){number, some_value(shader, number, seed)};
    }
    const spirv_source source = {shader->words, shader->word_count,
                                 constants,     shader->specialisation_count,
                                 validate,      checked};
    char message[SPIRV_MESSAGE_SIZE];
    checked->shader = shader->name;
    if (!third_party_spirv_specialise(&source, message))
        fail_msg("%s: %s", shader->name, message);
}

static void shaders_of_the_library_stay_valid(void **state) {
    (void)state;
    validation checked = {.context = spvContextCreate(SPV_ENV_VULKAN_1_3)};
    uint32_t seed = 1;
    // Neighbours in the list are variants of one source.
    for (size_t i = 0; i < engine_embedded_shaders_count; i += 4) {
        const engine_shader *shader = find(engine_embedded_shaders[i].name);
        if (shader->specialisation_count > 0)
            check_validity(shader, &checked, &seed);
    }
    spvContextDestroy(checked.context);
}

static void damaged_words_are_refused(void **state) {
    (void)state;
    const engine_shader *shader = find("reflection.comp");
    engine_shader damaged = *shader;
    damaged.word_count -= 3;
    VkShaderModule module;
    const lobe_specialisation value = {7, 1};
    assert_int_equal(engine_module_create(device, &damaged, &value, 1, &module), LOBE_ERROR_SHADER);
    assert_true(module == VK_NULL_HANDLE);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "shader 'reflection.comp' cannot be specialised"));
}

#define WITH_DEVICE(test) cmocka_unit_test_setup_teardown(test, open_device, close_device)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_DEVICE(constants_become_values),
        WITH_DEVICE(unreachable_code_is_removed),
        WITH_DEVICE(operations_on_constants_are_computed),
        WITH_DEVICE(shaders_of_the_library_stay_valid),
        WITH_DEVICE(damaged_words_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
