#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include "engine/device/device.h"
#include "engine/resource/content.h"
#include "engine/resource/resource.h"
#include "tests/engine/support/log_recorder.h"

static log_recorder recorder;
static lobe_device *device;

static int open_device(void **state) {
    (void)state;
    log_recorder_start(&recorder);
    return lobe_device_create(&(lobe_device_parameters){.validation = true, .host = &recorder.host},
                              &device) != LOBE_OK;
}

/// After every test, the validation layer has reported nothing and all memory has been freed.
static int close_device(void **state) {
    (void)state;
    lobe_device_memory memory;
    lobe_device_memory_query(device, &memory);
    const uint64_t mistakes = lobe_device_validation_count(device);
    lobe_device_destroy(&device);
    return mistakes || memory.used_bytes;
}

static void barrier_before_copy(VkCommandBuffer commands, const lobe_texture *texture,
                                VkImageLayout from, VkImageLayout to) {
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT,
        .oldLayout = from,
        .newLayout = to,
        .image = texture->image,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
    };
    vkCmdPipelineBarrier2(commands, &(VkDependencyInfo){
                                        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                        .imageMemoryBarrierCount = 1,
                                        .pImageMemoryBarriers = &barrier,
                                    });
}

static void assert_texture_holds(const lobe_texture *texture, const void *expected, size_t size) {
    engine_staging staging;
    VkCommandBuffer commands;
    uint64_t value;
    assert_int_equal(
        engine_staging_create(device, "read back", size, ENGINE_MEMORY_READ_BACK, &staging),
        LOBE_OK);
    assert_int_equal(engine_device_begin_commands(device, "read back", &commands), LOBE_OK);
    barrier_before_copy(commands, texture, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImageToBuffer(commands, texture->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           staging.buffer, 1,
                           &(VkBufferImageCopy){
                               .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                               .imageExtent = {texture->width, texture->height, 1},
                           });
    barrier_before_copy(commands, texture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    assert_int_equal(engine_device_submit_commands(device, "read back", commands, &value), LOBE_OK);
    assert_int_equal(engine_device_finish_commands(device, commands, value), LOBE_OK);
    assert_memory_equal(staging.mapped, expected, size);
    engine_staging_destroy(device, &staging);
}

static void assert_buffer_holds(const lobe_buffer *buffer, const void *expected, size_t size) {
    engine_staging staging;
    VkCommandBuffer commands;
    uint64_t value;
    assert_int_equal(
        engine_staging_create(device, "read back", size, ENGINE_MEMORY_READ_BACK, &staging),
        LOBE_OK);
    assert_int_equal(engine_device_begin_commands(device, "read back", &commands), LOBE_OK);
    vkCmdCopyBuffer(commands, buffer->buffer, staging.buffer, 1, &(VkBufferCopy){.size = size});
    assert_int_equal(engine_device_submit_commands(device, "read back", commands, &value), LOBE_OK);
    assert_int_equal(engine_device_finish_commands(device, commands, value), LOBE_OK);
    assert_memory_equal(staging.mapped, expected, size);
    engine_staging_destroy(device, &staging);
}

static void *pattern(size_t size, uint32_t seed) {
    uint8_t *bytes = malloc(size);
    assert_non_null(bytes);
    for (size_t i = 0; i < size; i++) {
        seed = seed * 1664525u + 1013904223u;
        bytes[i] = (uint8_t)(seed >> 24);
    }
    return bytes;
}

static void texture_holds_what_it_was_given(void **state) {
    (void)state;
    static const lobe_format formats[] = {LOBE_FORMAT_R8_UNORM, LOBE_FORMAT_RG8_UNORM,
                                          LOBE_FORMAT_RGBA8_SRGB, LOBE_FORMAT_RGBA16_UNORM};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        const size_t size = 7 * 5 * lobe_format_size(formats[i]);
        lobe_image image = {formats[i], 7, 5, pattern(size, 1)};
        lobe_texture *texture = NULL;
        assert_int_equal(
            lobe_texture_create(device, &(lobe_texture_parameters){"odd", &image}, &texture),
            LOBE_OK);
        assert_texture_holds(texture, image.texels, size);
        lobe_texture_destroy(&texture);
        assert_null(texture);
        free(image.texels);
    }
}

static void texture_larger_than_a_step_is_whole(void **state) {
    (void)state;
    const uint32_t width = 1500, height = 1001;
    const size_t size = (size_t)width * height * 16;
    assert_true(size > ENGINE_CONTENT_STEP);
    lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, width, height, calloc(size, 1)};
    for (size_t i = 0; i < size / 4; i++)
        ((float *)image.texels)[i] = (float)i;
    lobe_texture *texture = NULL;
    assert_int_equal(
        lobe_texture_create(device, &(lobe_texture_parameters){"large", &image}, &texture),
        LOBE_OK);
    assert_texture_holds(texture, image.texels, size);
    lobe_texture_destroy(&texture);
    free(image.texels);
}

static void update_replaces_the_content_and_its_stamp(void **state) {
    (void)state;
    uint8_t first[4] = {1, 2, 3, 4}, second[4] = {5, 6, 7, 8};
    lobe_image image = {LOBE_FORMAT_R8_UNORM, 2, 2, first};
    lobe_texture *texture = NULL, *other = NULL;
    const lobe_texture_parameters parameters = {NULL, &image};
    assert_int_equal(lobe_texture_create(device, &parameters, &texture), LOBE_OK);
    assert_int_equal(lobe_texture_create(device, &parameters, &other), LOBE_OK);
    const uint64_t stamp = texture->stamp;
    assert_true(stamp > 0);
    assert_int_equal(stamp, other->stamp);
    image.texels = second;
    assert_int_equal(lobe_texture_update(texture, &image), LOBE_OK);
    assert_int_not_equal(texture->stamp, stamp);
    assert_texture_holds(texture, second, sizeof second);
    assert_texture_holds(other, first, sizeof first);
    lobe_texture_destroy(&texture);
    lobe_texture_destroy(&other);
}

static void update_of_another_shape_is_refused(void **state) {
    (void)state;
    uint8_t texels[16] = {0};
    lobe_image image = {LOBE_FORMAT_R8_UNORM, 2, 2, texels};
    lobe_texture *texture = NULL;
    assert_int_equal(
        lobe_texture_create(device, &(lobe_texture_parameters){"map", &image}, &texture), LOBE_OK);
    const uint64_t stamp = texture->stamp;
    const lobe_image wrong[] = {
        {LOBE_FORMAT_R8_UNORM, 2, 3, texels},
        {LOBE_FORMAT_R8_UNORM, 3, 2, texels},
        {LOBE_FORMAT_RGBA8_UNORM, 2, 2, texels},
        {LOBE_FORMAT_R8_UNORM, 2, 2, NULL},
    };
    for (int i = 0; i < 4; i++) {
        assert_int_equal(lobe_texture_update(texture, &wrong[i]), LOBE_ERROR_INVALID_ARGUMENT);
        assert_int_equal(recorder.errors, i + 1);
        assert_non_null(strstr(recorder.last_error, "'map'"));
    }
    assert_int_equal(lobe_texture_update(texture, NULL), LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(texture->stamp, stamp);
    lobe_texture_destroy(&texture);
}

static void assert_no_texture(const lobe_image *image, lobe_result expected) {
    lobe_texture *texture = (lobe_texture *)&recorder;
    const int errors = recorder.errors;
    assert_int_equal(
        lobe_texture_create(device, &(lobe_texture_parameters){"bad", image}, &texture), expected);
    assert_null(texture);
    assert_int_equal(recorder.errors, errors + 1);
    assert_non_null(strstr(recorder.last_error, "'bad'"));
}

static void unusable_images_are_refused(void **state) {
    (void)state;
    uint8_t texels[16] = {0};
    const uint32_t most = lobe_device_describe(device)->maximum_image_extent;
    assert_no_texture(NULL, LOBE_ERROR_INVALID_ARGUMENT);
    assert_no_texture(&(lobe_image){LOBE_FORMAT_NONE, 1, 1, texels}, LOBE_ERROR_INVALID_ARGUMENT);
    assert_no_texture(&(lobe_image){LOBE_FORMAT_R8_UNORM, 0, 1, texels},
                      LOBE_ERROR_INVALID_ARGUMENT);
    assert_no_texture(&(lobe_image){LOBE_FORMAT_R8_UNORM, 1, 0, texels},
                      LOBE_ERROR_INVALID_ARGUMENT);
    assert_no_texture(&(lobe_image){LOBE_FORMAT_D32_FLOAT, 1, 1, texels},
                      LOBE_ERROR_INVALID_ARGUMENT);
    assert_no_texture(&(lobe_image){LOBE_FORMAT_R8_UNORM, most + 1, 1, texels}, LOBE_ERROR_LIMIT);
    assert_no_texture(&(lobe_image){LOBE_FORMAT_R8_UNORM, 1, most + 1, texels}, LOBE_ERROR_LIMIT);
}

static void texture_beyond_the_memory_limit_is_refused(void **state) {
    (void)state;
    lobe_device *small = NULL;
    lobe_texture *texture = NULL;
    uint8_t *texels = calloc(2048 * 2048, 4);
    const lobe_image image = {LOBE_FORMAT_RGBA8_UNORM, 2048, 2048, texels};
    assert_int_equal(
        lobe_device_create(
            &(lobe_device_parameters){.memory_limit = 1 << 20, .host = &recorder.host}, &small),
        LOBE_OK);
    assert_int_equal(
        lobe_texture_create(small, &(lobe_texture_parameters){"huge", &image}, &texture),
        LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_null(texture);
    assert_int_equal(recorder.errors, 1);
    lobe_device_destroy(&small);
    free(texels);
}

static void buffer_holds_what_it_was_given(void **state) {
    (void)state;
    static const size_t sizes[] = {1, 3, 4, 4099, ENGINE_CONTENT_STEP + 12};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        void *data = pattern(sizes[i], 5);
        lobe_buffer *buffer = NULL;
        assert_int_equal(
            lobe_buffer_create(device, &(lobe_buffer_parameters){"data", sizes[i], data}, &buffer),
            LOBE_OK);
        assert_buffer_holds(buffer, data, sizes[i]);
        free(data);
        data = pattern(sizes[i], 6);
        const uint64_t stamp = buffer->stamp;
        assert_int_equal(lobe_buffer_update(buffer, data), LOBE_OK);
        assert_int_not_equal(buffer->stamp, stamp);
        assert_buffer_holds(buffer, data, sizes[i]);
        lobe_buffer_destroy(&buffer);
        assert_null(buffer);
        free(data);
    }
}

static void buffer_without_data_is_zero(void **state) {
    (void)state;
    static const uint8_t zeroes[102] = {0};
    lobe_buffer *buffer = NULL;
    assert_int_equal(
        lobe_buffer_create(device, &(lobe_buffer_parameters){.size = sizeof zeroes}, &buffer),
        LOBE_OK);
    assert_buffer_holds(buffer, zeroes, sizeof zeroes);
    lobe_buffer_destroy(&buffer);
}

static void unusable_buffers_are_refused(void **state) {
    (void)state;
    lobe_buffer *buffer = (lobe_buffer *)&recorder;
    assert_int_equal(
        lobe_buffer_create(device, &(lobe_buffer_parameters){"none", 0, NULL}, &buffer),
        LOBE_ERROR_INVALID_ARGUMENT);
    assert_null(buffer);
    const size_t too_large = (size_t)device->limits.maxStorageBufferRange + 4;
    assert_int_equal(
        lobe_buffer_create(device, &(lobe_buffer_parameters){"huge", too_large, NULL}, &buffer),
        LOBE_ERROR_LIMIT);
    assert_null(buffer);
    assert_int_equal(recorder.errors, 2);
    assert_int_equal(
        lobe_buffer_create(device, &(lobe_buffer_parameters){"tiny", 4, NULL}, &buffer), LOBE_OK);
    assert_int_equal(lobe_buffer_update(buffer, NULL), LOBE_ERROR_INVALID_ARGUMENT);
    lobe_buffer_destroy(&buffer);
}

static void destroying_nothing_is_fine(void **state) {
    (void)state;
    lobe_texture *texture = NULL;
    lobe_buffer *buffer = NULL;
    lobe_texture_destroy(&texture);
    lobe_buffer_destroy(&buffer);
}

static void validation_counts_mistakes(void **state) {
    (void)state;
    lobe_device *own = NULL;
    VkBuffer buffer = VK_NULL_HANDLE;
    log_recorder messages;
    log_recorder_start(&messages);
    assert_int_equal(
        lobe_device_create(&(lobe_device_parameters){.validation = true, .host = &messages.host},
                           &own),
        LOBE_OK);
    // Vulkan forbids a size of 0; our own functions would reject it first.
    const VkBufferCreateInfo wrong = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                      .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    if (vkCreateBuffer(own->vulkan, &wrong, NULL, &buffer) == VK_SUCCESS)
        vkDestroyBuffer(own->vulkan, buffer, NULL);
    assert_true(lobe_device_validation_count(own) > 0);
    assert_non_null(strstr(messages.last_error, "validation"));
    lobe_device_destroy(&own);
}

#define WITH_DEVICE(test) cmocka_unit_test_setup_teardown(test, open_device, close_device)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_DEVICE(texture_holds_what_it_was_given),
        WITH_DEVICE(texture_larger_than_a_step_is_whole),
        WITH_DEVICE(update_replaces_the_content_and_its_stamp),
        WITH_DEVICE(update_of_another_shape_is_refused),
        WITH_DEVICE(unusable_images_are_refused),
        WITH_DEVICE(texture_beyond_the_memory_limit_is_refused),
        WITH_DEVICE(buffer_holds_what_it_was_given),
        WITH_DEVICE(buffer_without_data_is_zero),
        WITH_DEVICE(unusable_buffers_are_refused),
        WITH_DEVICE(destroying_nothing_is_fine),
        cmocka_unit_test(validation_counts_mistakes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
