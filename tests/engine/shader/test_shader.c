#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "engine/device/device.h"
#include "engine/shader/reflection.h"
#include "engine/shader/shaders.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/test_shaders.h"

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
    const engine_shader *shader = NULL;
    assert_int_equal(engine_shader_find(device, name, &shader), LOBE_OK);
    assert_string_equal(shader->name, name);
    return shader;
}

static const engine_shader_binding *binding_of(const engine_shader *shader, const char *name) {
    for (size_t i = 0; i < shader->binding_count; i++)
        if (!strcmp(shader->bindings[i].name, name))
            return &shader->bindings[i];
    fail_msg("no binding named %s", name);
    return NULL;
}

static void bindings_are_ordered_and_named(void **state) {
    (void)state;
    static const char *const names[] = {"Camera",   "Source", "Target",       "Counter", "plane",
                                        "layered",  "sky",    "multisampled", "stored",  "written",
                                        "modified", "unused", "several"};
    const engine_shader *shader = find("reflection.comp");
    assert_int_equal(shader->binding_count, sizeof names / sizeof *names);
    for (size_t i = 0; i < shader->binding_count; i++) {
        assert_string_equal(shader->bindings[i].name, names[i]);
        assert_int_equal(shader->bindings[i].binding, i);
        assert_int_equal(shader->bindings[i].stages, VK_SHADER_STAGE_COMPUTE_BIT);
        assert_int_equal(shader->bindings[i].used, strcmp(names[i], "unused") != 0);
        assert_int_equal(shader->bindings[i].count, strcmp(names[i], "several") ? 1 : 3);
    }
}

static void blocks_have_kind_size_and_access(void **state) {
    (void)state;
    const struct {
        const char *name;
        VkDescriptorType type;
        size_t size;
        bool reads, writes;
    } expected[] = {
        {"Camera", VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 80, true, false},
        {"Source", VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 16, true, false},
        {"Target", VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 0, false, true},
        {"Counter", VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 4, true, true},
    };
    const engine_shader *shader = find("reflection.comp");
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const engine_shader_binding *binding = binding_of(shader, expected[i].name);
        assert_int_equal(binding->type, expected[i].type);
        assert_int_equal(binding->size, expected[i].size);
        assert_int_equal(binding->reads, expected[i].reads);
        assert_int_equal(binding->writes, expected[i].writes);
    }
}

static void images_have_kind_shape_format_and_access(void **state) {
    (void)state;
    const struct {
        const char *name;
        VkDescriptorType type;
        VkImageViewType view;
        lobe_format format;
        bool reads, writes, multisampled;
    } expected[] = {
        {"plane", VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_IMAGE_VIEW_TYPE_2D,
         LOBE_FORMAT_NONE, true, false, false},
        {"layered", VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_IMAGE_VIEW_TYPE_2D_ARRAY,
         LOBE_FORMAT_NONE, true, false, false},
        {"sky", VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_IMAGE_VIEW_TYPE_CUBE,
         LOBE_FORMAT_NONE, true, false, false},
        {"multisampled", VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_IMAGE_VIEW_TYPE_2D,
         LOBE_FORMAT_NONE, true, false, true},
        {"stored", VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_IMAGE_VIEW_TYPE_2D_ARRAY,
         LOBE_FORMAT_R32_FLOAT, true, false, false},
        {"written", VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_IMAGE_VIEW_TYPE_2D,
         LOBE_FORMAT_RGBA16_FLOAT, false, true, false},
        {"modified", VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_IMAGE_VIEW_TYPE_2D,
         LOBE_FORMAT_RGBA8_UNORM, true, true, false},
    };
    const engine_shader *shader = find("reflection.comp");
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const engine_shader_binding *binding = binding_of(shader, expected[i].name);
        assert_int_equal(binding->type, expected[i].type);
        assert_int_equal(binding->view, expected[i].view);
        assert_int_equal(binding->format, expected[i].format);
        assert_int_equal(binding->reads, expected[i].reads);
        assert_int_equal(binding->writes, expected[i].writes);
        assert_int_equal(binding->multisampled, expected[i].multisampled);
    }
}

static void compute_sizes_and_constants_are_known(void **state) {
    (void)state;
    const engine_shader *shader = find("reflection.comp");
    assert_int_equal(shader->stage, VK_SHADER_STAGE_COMPUTE_BIT);
    assert_int_equal(shader->push_constant_size, 20);
    assert_int_equal(shader->local_size[0], 8);
    assert_int_equal(shader->local_size[1], 4);
    assert_int_equal(shader->local_size[2], 2);
    assert_int_equal(shader->local_size_ids[0], UINT32_MAX);
    assert_int_equal(shader->specialisation_count, 2);
    assert_int_equal(shader->specialisation_ids[0] + shader->specialisation_ids[1], 3 + 7);
}

static void local_size_by_specialisation_is_known(void **state) {
    (void)state;
    const engine_shader *shader = find("fill.comp");
    assert_int_equal(shader->local_size_ids[0], 0);
    assert_int_equal(shader->local_size_ids[1], UINT32_MAX);
    assert_int_equal(shader->local_size[0], 1);
    assert_int_equal(shader->local_size[1], 1);
}

static void fragment_outputs_are_known(void **state) {
    (void)state;
    const engine_shader *shader = find("triangle.frag");
    assert_int_equal(shader->stage, VK_SHADER_STAGE_FRAGMENT_BIT);
    assert_int_equal(shader->output_locations, 1u << 0 | 1u << 2);
    assert_int_equal(find("triangle.vert")->stage, VK_SHADER_STAGE_VERTEX_BIT);
    assert_int_equal(find("triangle.vert")->output_locations, 0);
}

static void found_again_it_is_the_same(void **state) {
    (void)state;
    const engine_shader *first = find("fill.comp"), *other = find("reflection.comp");
    assert_ptr_equal(find("fill.comp"), first);
    assert_int_not_equal(first->version, other->version);
}

static void unknown_name_is_an_error_that_names_it(void **state) {
    (void)state;
    const engine_shader *shader = NULL;
    assert_int_equal(engine_shader_find(device, "nowhere.comp", &shader), LOBE_ERROR_SHADER);
    assert_null(shader);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "nowhere.comp"));
}

static void another_descriptor_set_is_refused(void **state) {
    (void)state;
    const engine_shader *shader = NULL;
    assert_int_equal(engine_shader_find(device, "second_set.comp", &shader), LOBE_ERROR_SHADER);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "Elsewhere"));
}

static void words_that_are_no_spirv_are_refused(void **state) {
    (void)state;
    static const uint32_t words[8] = {0x07230203, 0x00010600, 1, 2, 3, 4, 5, 6};
    for (size_t count = 0; count <= 8; count++) {
        engine_shader shader = {.name = "noise"};
        const int errors = recorder.errors;
        assert_int_equal(engine_reflect(&recorder.host, words, count, &shader), LOBE_ERROR_SHADER);
        assert_int_equal(recorder.errors, errors + 1);
        engine_reflection_free(&shader);
    }
}

static void every_embedded_shader_is_usable(void **state) {
    (void)state;
    assert_true(engine_embedded_shaders_count > 0);
    for (size_t i = 0; i < engine_embedded_shaders_count; i++)
        find(engine_embedded_shaders[i].name);
}

static void filters_have_variants_with_and_without_aov(void **state) {
    (void)state;
    const engine_shader *plain = find("shading/shading_lobes.frag"),
                        *aov = find("shading/shading_lobes_aov.frag");
    assert_int_equal(plain->output_locations & 1, 1);
    assert_int_equal(aov->output_locations & plain->output_locations, plain->output_locations);
    assert_int_not_equal(aov->output_locations, plain->output_locations);
}

#define WITH_DEVICE(test) cmocka_unit_test_setup_teardown(test, open_device, close_device)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_DEVICE(bindings_are_ordered_and_named),
        WITH_DEVICE(blocks_have_kind_size_and_access),
        WITH_DEVICE(images_have_kind_shape_format_and_access),
        WITH_DEVICE(compute_sizes_and_constants_are_known),
        WITH_DEVICE(local_size_by_specialisation_is_known),
        WITH_DEVICE(fragment_outputs_are_known),
        WITH_DEVICE(found_again_it_is_the_same),
        WITH_DEVICE(unknown_name_is_an_error_that_names_it),
        WITH_DEVICE(another_descriptor_set_is_refused),
        WITH_DEVICE(words_that_are_no_spirv_are_refused),
        WITH_DEVICE(every_embedded_shader_is_usable),
        WITH_DEVICE(filters_have_variants_with_and_without_aov),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
