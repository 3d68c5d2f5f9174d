// No shader of the library has more samplers than lavapipe allows a stage: materials and settings
// decide which of them a pipeline keeps, and no test draws all combinations. Read from the SPIR-V
// (specification 1.6, section 3.42).

#include <stdlib.h>

#include "engine/shader/shaders.h"
#include "tests/engine/support/cmocka_all.h"

enum {
    HEADER_WORDS = 5,
    OP_TYPE_SAMPLER = 26,
    OP_TYPE_SAMPLED_IMAGE = 27,
    OP_TYPE_POINTER = 32,
    OP_VARIABLE = 59,
    MOST_SAMPLERS = 32, ///< maxPerStageDescriptorSamplers of Mesa 22.3
};

static bool is_sampler(const uint32_t *instruction) {
    const uint32_t operation = instruction[0] & 0xffff;
    return operation == OP_TYPE_SAMPLER || operation == OP_TYPE_SAMPLED_IMAGE;
}

/// Types come before pointers to them, and pointers before variables.
static uint32_t count_samplers(const engine_shader_code *code) {
    const size_t count = code->size / sizeof *code->words;
    bool *holds_sampler = calloc(code->words[3], sizeof *holds_sampler);
    assert_non_null(holds_sampler);
    uint32_t samplers = 0;
    for (size_t i = HEADER_WORDS; i < count; i += code->words[i] >> 16) {
        const uint32_t *instruction = code->words + i;
        const uint32_t operation = instruction[0] & 0xffff;
        if (is_sampler(instruction))
            holds_sampler[instruction[1]] = true;
        else if (operation == OP_TYPE_POINTER)
            holds_sampler[instruction[1]] = holds_sampler[instruction[3]];
        else if (operation == OP_VARIABLE)
            samplers += holds_sampler[instruction[1]];
    }
    free(holds_sampler);
    return samplers;
}

static void every_shader_fits_lavapipe(void **state) {
    (void)state;
    uint32_t most = 0;
    for (size_t i = 0; i < engine_embedded_shaders_count; i++) {
        const uint32_t count = count_samplers(&engine_embedded_shaders[i]);
        most = count > most ? count : most;
        if (count > MOST_SAMPLERS)
            fail_msg("%s has %u samplers: read some of its maps with texelFetch, without one",
                     engine_embedded_shaders[i].name, count);
    }
    assert_true(most > 16);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_shader_fits_lavapipe)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
