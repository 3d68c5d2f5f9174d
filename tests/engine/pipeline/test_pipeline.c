#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/device/device.h"
#include "engine/pipeline/pipelines.h"
#include "engine/resource/resource.h"
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

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static const engine_pipeline *compute(const lobe_specialisation *values, size_t count) {
    const engine_pipeline *pipeline = NULL;
    assert_int_equal(
        engine_pipeline_compute(device, &(engine_compute_parameters){"fill.comp", values, count},
                                &pipeline),
        LOBE_OK);
    return pipeline;
}

/// NULL if the pipeline has no binding of that name.
static const engine_shader_binding *binding_of(const engine_pipeline *pipeline, const char *name) {
    for (size_t i = 0; i < pipeline->binding_count; i++)
        if (!strcmp(pipeline->bindings[i].name, name))
            return &pipeline->bindings[i];
    return NULL;
}

// ---------------------------------------------------------------------------------------------
// Compute

static VkDescriptorSet bind_buffer(const engine_pipeline *pipeline, VkBuffer buffer,
                                   VkDescriptorPool *pool) {
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
    const VkDescriptorPoolCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 1,
        .poolSizeCount = 1,
        .pPoolSizes = &size,
    };
    assert_int_equal(vkCreateDescriptorPool(device->vulkan, &create, NULL, pool), VK_SUCCESS);
    const VkDescriptorSetAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = *pool,
        .descriptorSetCount = 1,
        .pSetLayouts = &pipeline->set_layout,
    };
    VkDescriptorSet set;
    assert_int_equal(vkAllocateDescriptorSets(device->vulkan, &allocate, &set), VK_SUCCESS);
    const VkDescriptorBufferInfo whole = {buffer, 0, VK_WHOLE_SIZE};
    const VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = set,
        .dstBinding = binding_of(pipeline, "Target")->binding,
        .descriptorCount = 1,
        .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        .pBufferInfo = &whole,
    };
    vkUpdateDescriptorSets(device->vulkan, 1, &write, 0, NULL);
    return set;
}

static void run_fill(const engine_pipeline *pipeline, uint32_t count, engine_staging *target) {
    VkDescriptorPool pool;
    VkCommandBuffer commands;
    uint64_t value;
    const VkDescriptorSet set = bind_buffer(pipeline, target->buffer, &pool);
    assert_int_equal(engine_device_begin_commands(device, "fill", &commands), LOBE_OK);
    engine_device_begin_label(device, commands, "fill");
    vkCmdBindPipeline(commands, pipeline->bind_point, pipeline->pipeline);
    vkCmdBindDescriptorSets(commands, pipeline->bind_point, pipeline->layout, 0, 1, &set, 0, NULL);
    vkCmdPushConstants(commands, pipeline->layout, pipeline->push_constant_stages, 0, sizeof count,
                       &count);
    vkCmdDispatch(commands, (count + pipeline->local_size[0] - 1) / pipeline->local_size[0], 1, 1);
    engine_device_end_label(device, commands);
    assert_int_equal(engine_device_submit_commands(device, "fill", commands, &value), LOBE_OK);
    assert_int_equal(engine_device_finish_commands(device, commands, value), LOBE_OK);
    vkDestroyDescriptorPool(device->vulkan, pool, NULL);
}

static void compute_runs_with_its_specialisation(void **state) {
    (void)state;
    const uint32_t count = 1000;
    const lobe_specialisation values[] = {{0, 32}, {1, bits_of(2.5f)}, {99, 7}};
    const engine_pipeline *pipeline = compute(values, 3);
    assert_int_equal(pipeline->local_size[0], 32);
    assert_int_equal(pipeline->push_constant_size, 4);
    engine_staging target;
    assert_int_equal(engine_staging_create(device, "target", count * sizeof(float),
                                           ENGINE_MEMORY_READ_BACK, &target),
                     LOBE_OK);
    run_fill(pipeline, count, &target);
    for (uint32_t i = 0; i < count; i++)
        assert_true(((const float *)target.mapped)[i] == 2.5f * (float)i);
    engine_staging_destroy(device, &target);
}

static void same_request_gives_the_same_pipeline(void **state) {
    (void)state;
    const lobe_specialisation values[] = {{0, 8}, {1, bits_of(2)}};
    const lobe_specialisation reversed[] = {{1, bits_of(2)}, {0, 8}};
    const lobe_specialisation with_unknown[] = {{0, 8}, {50, 1}, {1, bits_of(2)}};
    const lobe_specialisation other[] = {{0, 8}, {1, bits_of(3)}};
    const engine_pipeline *pipeline = compute(values, 2);
    assert_ptr_equal(compute(values, 2), pipeline);
    assert_ptr_equal(compute(reversed, 2), pipeline);
    assert_ptr_equal(compute(with_unknown, 3), pipeline);
    assert_ptr_not_equal(compute(other, 2), pipeline);
    assert_ptr_not_equal(compute(values, 1), pipeline);
    assert_ptr_not_equal(compute(NULL, 0), pipeline);
}

static void too_large_groups_are_refused(void **state) {
    (void)state;
    const lobe_specialisation values[] = {{0, 1u << 24}}, none[] = {{0, 0}};
    const engine_pipeline *pipeline = NULL;
    assert_int_equal(engine_pipeline_compute(
                         device, &(engine_compute_parameters){"fill.comp", values, 1}, &pipeline),
                     LOBE_ERROR_LIMIT);
    assert_null(pipeline);
    assert_int_equal(engine_pipeline_compute(
                         device, &(engine_compute_parameters){"fill.comp", none, 1}, &pipeline),
                     LOBE_ERROR_LIMIT);
    assert_int_equal(recorder.errors, 2);
}

static void shader_of_another_stage_is_refused(void **state) {
    (void)state;
    const engine_pipeline *pipeline = NULL;
    assert_int_equal(
        engine_pipeline_compute(device, &(engine_compute_parameters){.shader = "triangle.vert"},
                                &pipeline),
        LOBE_ERROR_SHADER);
    assert_non_null(strstr(recorder.last_error, "triangle.vert"));
    assert_int_equal(recorder.errors, 1);
}

// ---------------------------------------------------------------------------------------------
// Raster

static engine_raster_parameters triangle(void) {
    return (engine_raster_parameters){
        .vertex_shader = "triangle.vert",
        .fragment_shader = "triangle.frag",
        .depth_test = true,
        .depth_write = true,
        .colour = {LOBE_FORMAT_RGBA32_FLOAT, LOBE_FORMAT_NONE, LOBE_FORMAT_RGBA8_UNORM},
        .depth = LOBE_FORMAT_D32_FLOAT,
    };
}

static const engine_pipeline *raster(const engine_raster_parameters *parameters) {
    const engine_pipeline *pipeline = NULL;
    assert_int_equal(engine_pipeline_raster(device, parameters, &pipeline), LOBE_OK);
    assert_int_equal(pipeline->bind_point, VK_PIPELINE_BIND_POINT_GRAPHICS);
    return pipeline;
}

static void stages_are_merged(void **state) {
    (void)state;
    const engine_raster_parameters parameters = triangle();
    const engine_pipeline *pipeline = raster(&parameters);
    const VkShaderStageFlags both = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    assert_int_equal(pipeline->binding_count, 2);
    assert_int_equal(binding_of(pipeline, "Vertices")->stages, both);
    assert_int_equal(binding_of(pipeline, "colours")->stages, VK_SHADER_STAGE_FRAGMENT_BIT);
    assert_null(binding_of(pipeline, "elsewhere"));
    assert_null(binding_of(pipeline, "unused"));
    assert_int_equal(pipeline->push_constant_size, 32);
    assert_int_equal(pipeline->push_constant_stages, both);
    assert_int_equal(pipeline->output_locations, 1u << 0 | 1u << 2);
}

static void each_state_makes_its_own_pipeline(void **state) {
    (void)state;
    enum { VARIANTS = 9 };
    engine_raster_parameters variants[VARIANTS];
    const engine_pipeline *pipelines[VARIANTS];
    for (int i = 0; i < VARIANTS; i++)
        variants[i] = triangle();
    variants[1].cull = LOBE_CULL_BACK;
    variants[2].blend = LOBE_BLEND_ADD;
    variants[3].depth_write = false;
    variants[4].depth_test = false;
    variants[5].samples = 4;
    variants[6].colour[0] = LOBE_FORMAT_RGBA16_FLOAT;
    variants[7].depth = LOBE_FORMAT_NONE;
    variants[7].depth_test = variants[7].depth_write = false;
    variants[8].depth_equal = true;
    for (int i = 0; i < VARIANTS; i++) {
        pipelines[i] = raster(&variants[i]);
        assert_ptr_equal(raster(&variants[i]), pipelines[i]);
        for (int j = 0; j < i; j++)
            assert_ptr_not_equal(pipelines[i], pipelines[j]);
    }
}

static void depth_alone_needs_no_fragment_shader(void **state) {
    (void)state;
    const engine_raster_parameters parameters = {
        .vertex_shader = "triangle.vert",
        .depth_test = true,
        .depth_write = true,
        .depth = LOBE_FORMAT_D32_FLOAT,
    };
    const engine_pipeline *pipeline = raster(&parameters);
    assert_int_equal(pipeline->output_locations, 0);
    assert_int_equal(pipeline->push_constant_stages, VK_SHADER_STAGE_VERTEX_BIT);
}

static void disagreeing_stages_are_refused(void **state) {
    (void)state;
    engine_raster_parameters parameters = triangle();
    const engine_pipeline *pipeline = NULL;
    parameters.fragment_shader = "disagreeing.frag";
    assert_int_equal(engine_pipeline_raster(device, &parameters, &pipeline), LOBE_ERROR_SHADER);
    assert_null(pipeline);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "disagreeing.frag"));
    assert_non_null(strstr(recorder.last_error, "Vertices"));
}

// ---------------------------------------------------------------------------------------------
// Samplers

/// The fragment shader has one.
static void more_samplers_than_a_stage_may_have_are_refused(void **state) {
    (void)state;
    engine_raster_parameters parameters = triangle();
    parameters.cull = LOBE_CULL_FRONT; // a pipeline of its own
    const engine_pipeline *pipeline = NULL;
    const uint32_t most = device->limits.maxPerStageDescriptorSamplers;
    device->limits.maxPerStageDescriptorSamplers = 0;
    assert_int_equal(engine_pipeline_raster(device, &parameters, &pipeline), LOBE_ERROR_LIMIT);
    device->limits.maxPerStageDescriptorSamplers = most;
    assert_null(pipeline);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "1 samplers"));
    assert_int_equal(engine_pipeline_raster(device, &parameters, &pipeline), LOBE_OK);
}

static void samplers_are_shared(void **state) {
    (void)state;
    VkSampler first, second, third, most, above;
    const lobe_sampler settings = {.texels = LOBE_SAMPLE_LINEAR, .wrap_u = LOBE_WRAP_CLAMP};
    lobe_sampler other = settings;
    other.wrap_v = LOBE_WRAP_MIRROR;
    assert_int_equal(engine_sampler(device, &settings, &first), LOBE_OK);
    assert_int_equal(engine_sampler(device, &settings, &second), LOBE_OK);
    assert_int_equal(engine_sampler(device, &other, &third), LOBE_OK);
    assert_ptr_equal(first, second);
    assert_ptr_not_equal(first, third);
    other.maximum_anisotropy = device->limits.maxSamplerAnisotropy;
    assert_int_equal(engine_sampler(device, &other, &most), LOBE_OK);
    other.maximum_anisotropy = 1000;
    assert_int_equal(engine_sampler(device, &other, &above), LOBE_OK);
    assert_ptr_equal(most, above);
}

// ---------------------------------------------------------------------------------------------
// The cache file

static char folder[] = "/tmp/lobe_test_XXXXXX";
static char cache_path[64];

static int make_folder(void **state) {
    (void)state;
    strcpy(folder + strlen(folder) - 6, "XXXXXX");
    log_recorder_start(&recorder);
    if (!mkdtemp(folder))
        return 1;
    snprintf(cache_path, sizeof cache_path, "%s/pipelines", folder);
    return 0;
}

/// Also shows that nothing else was left behind.
static int remove_folder(void **state) {
    (void)state;
    unlink(cache_path);
    return rmdir(folder);
}

static void run_with_cache(void) {
    assert_int_equal(open_device_with_test_shaders(&recorder.host, cache_path, &device), LOBE_OK);
    compute(NULL, 0);
    assert_int_equal(lobe_device_validation_count(device), 0);
    lobe_device_destroy(&device);
    assert_int_equal(recorder.errors + recorder.warnings, 0);
}

static long read_cache(char *content, size_t size) {
    FILE *file = fopen(cache_path, "rb");
    assert_non_null(file);
    const size_t length = fread(content, 1, size, file);
    fclose(file);
    assert_true(length < size);
    return (long)length;
}

static void write_cache(const char *content, size_t size) {
    FILE *file = fopen(cache_path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(content, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static char first[1 << 20], second[1 << 20];

static void cache_file_is_written_and_read_again(void **state) {
    (void)state;
    run_with_cache();
    const long length = read_cache(first, sizeof first);
    assert_true(length > (long)sizeof(VkPipelineCacheHeaderVersionOne));
    struct stat before, after;
    assert_int_equal(stat(cache_path, &before), 0);
    run_with_cache();
    assert_int_equal(stat(cache_path, &after), 0);
    assert_int_equal(read_cache(second, sizeof second), length);
    assert_memory_equal(first, second, (size_t)length);
    // Nothing new was compiled, so the file was left alone.
    assert_int_equal(before.st_ino, after.st_ino);
}

static void damaged_cache_files_are_replaced(void **state) {
    (void)state;
    run_with_cache();
    const size_t length = (size_t)read_cache(first, sizeof first);
    // Every byte matters: our header, Vulkan's, the data. Tests some bytes and some lengths.
    for (size_t i = 0; i < length; i += 1 + length / 16) {
        memcpy(second, first, length);
        second[i] ^= 0x40;
        write_cache(second, length);
        run_with_cache();
        assert_int_equal(read_cache(second, sizeof second), length);
        assert_memory_equal(first, second, length);
    }
    for (size_t cut = 0; cut < length; cut += 1 + length / 8) {
        write_cache(first, cut);
        run_with_cache();
        assert_int_equal(read_cache(second, sizeof second), length);
    }
}

static void unwritable_cache_file_is_only_a_warning(void **state) {
    (void)state;
    char missing[96];
    snprintf(missing, sizeof missing, "%s/missing/pipelines", folder);
    assert_int_equal(open_device_with_test_shaders(&recorder.host, missing, &device), LOBE_OK);
    lobe_device_destroy(&device);
    assert_int_equal(recorder.errors, 0);
    assert_int_equal(recorder.warnings, 1);
    assert_non_null(strstr(recorder.last_warning, missing));
}

#define WITH_DEVICE(test) cmocka_unit_test_setup_teardown(test, open_device, close_device)
#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_DEVICE(compute_runs_with_its_specialisation),
        WITH_DEVICE(same_request_gives_the_same_pipeline),
        WITH_DEVICE(too_large_groups_are_refused),
        WITH_DEVICE(shader_of_another_stage_is_refused),
        WITH_DEVICE(stages_are_merged),
        WITH_DEVICE(each_state_makes_its_own_pipeline),
        WITH_DEVICE(depth_alone_needs_no_fragment_shader),
        WITH_DEVICE(disagreeing_stages_are_refused),
        WITH_DEVICE(more_samplers_than_a_stage_may_have_are_refused),
        WITH_DEVICE(samplers_are_shared),
        WITH_FOLDER(cache_file_is_written_and_read_again),
        WITH_FOLDER(damaged_cache_files_are_replaced),
        WITH_FOLDER(unwritable_cache_file_is_only_a_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
