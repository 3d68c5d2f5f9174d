// Frames of a host that uses Vulkan itself: into its images, with its semaphores or in its command
// buffers, several in flight.

#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include "tests/engine/support/host_device.h"
#include "tests/engine/support/test_shaders.h"

#define SIZE 8

typedef struct fixture {
    host_device host;
    lobe_device *device;
    lobe_graph *graph;
} fixture;

static int open_fixture(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    host_device_open(&f->host);
    f->device = host_device_import(&f->host);
    return add_test_shaders(f->device) != LOBE_OK ||
           lobe_graph_create(f->device, &f->graph) != LOBE_OK;
}

static int close_fixture(void **state) {
    fixture *f = *state;
    lobe_device_memory memory;
    lobe_graph_destroy(&f->graph);
    lobe_device_memory_query(f->device, &memory);
    assert_int_equal(memory.used_bytes, 0);
    lobe_device_destroy(&f->device);
    host_device_close(&f->host);
    free(f);
    return 0;
}

// ---------------------------------------------------------------------------------------------
// Pictures

static const VkImageUsageFlags all_usages =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
    VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

static host_image picture(fixture *f) {
    return host_image_create(&f->host, VK_FORMAT_R32G32B32A32_SFLOAT, SIZE, SIZE, all_usages);
}

/// The image as passes get it; the frame leaves it ready for copies.
static lobe_vulkan_image lend(const host_image *image, VkImageLayout layout) {
    return (lobe_vulkan_image){.image = image->image,
                               .format = image->format,
                               .width = image->width,
                               .height = image->height,
                               .usage = all_usages,
                               .layout = layout,
                               .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
}

/// Draws a triangle of one colour over the lower left half.
static lobe_resource draw_half(fixture *f, lobe_resource target, lobe_load load, float red) {
    static const float half[] = {-1, -1, -1, 1, 1, 1};
    const struct {
        float colour[4];
        float depth;
    } constants = {{red, 0, 0, 1}, 0};
    const lobe_binding binding = {.name = "vertex_block",
                                  .resource =
                                      lobe_graph_upload(f->graph, "vertices", half, sizeof half)};
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_RASTER, "half");
    target = lobe_pass_colour(
        pass, 0, &(lobe_attachment){.resource = target, .load = load, .clear = {0, 0, 1, 1}});
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "graph_triangle.vert",
                                      .fragment_shader = "graph_triangle.frag",
                                      .index_count = 3,
                                      .constants = &constants,
                                      .constants_size = 20,
                                      .bindings = &binding,
                                      .binding_count = 1});
    lobe_graph_output(f->graph, target);
    return target;
}

static void expect(fixture *f, const host_image *image, float low_left_red, float up_right_blue) {
    float texels[SIZE][SIZE][4];
    host_read(&f->host, image, texels, sizeof texels);
    assert_float_equal(texels[SIZE - 2][1][0], low_left_red, 0);
    assert_float_equal(texels[SIZE - 2][1][2], 0, 0);
    assert_float_equal(texels[1][SIZE - 2][0], 0, 0);
    assert_float_equal(texels[1][SIZE - 2][2], up_right_blue, 0);
}

/// All texels have this blue.
static void expect_all(fixture *f, const host_image *image, float blue) {
    float texels[SIZE][SIZE][4];
    host_read(&f->host, image, texels, sizeof texels);
    for (int i = 0; i < SIZE * SIZE; i++)
        assert_float_equal(texels[i / SIZE][i % SIZE][2], blue, 0);
}

static void check(fixture *f, lobe_result result) {
    if (result != LOBE_OK)
        fail_msg("%s", f->host.recorder.last_error);
}

// ---------------------------------------------------------------------------------------------
// Images

static void a_frame_draws_into_the_hosts_image(void **state) {
    fixture *f = *state;
    host_image image = picture(f);
    lobe_graph_begin(f->graph);
    lobe_vulkan_image lent = lend(&image, VK_IMAGE_LAYOUT_UNDEFINED);
    draw_half(f, lobe_graph_import_image(f->graph, &lent), LOBE_LOAD_CLEAR, 0.5f);
    check(f, lobe_graph_execute(f->graph));
    expect(f, &image, 0.5f, 1);
    host_image_destroy(&f->host, &image);
}

/// Clears the host's image to green, with the host's own commands.
static void fill_green(const host_image *image, VkCommandBuffer commands) {
    host_barrier(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    host_clear(commands, image, (float[]){0, 1, 0.25f, 1});
}

/// A picture that the host cleared to green.
static host_image green_picture(fixture *f) {
    host_image image = picture(f);
    VkCommandBuffer commands = host_begin(&f->host);
    fill_green(&image, commands);
    host_finish(&f->host, commands);
    return image;
}

static void what_the_host_drew_is_kept(void **state) {
    fixture *f = *state;
    host_image image = green_picture(f);
    lobe_graph_begin(f->graph);
    lobe_vulkan_image lent = lend(&image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    draw_half(f, lobe_graph_import_image(f->graph, &lent), LOBE_LOAD_KEEP, 0.5f);
    check(f, lobe_graph_execute(f->graph));
    expect(f, &image, 0.5f, 0.25f);
    host_image_destroy(&f->host, &image);
}

/// A copy of what the host gives, kept between frames.
static lobe_pass_state copy_kept(fixture *f, lobe_resource source, lobe_resource copy) {
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "copy");
    copy = lobe_pass_copy(pass, source, (lobe_range){0}, copy, (lobe_range){0});
    lobe_graph_output(f->graph, copy);
    check(f, lobe_graph_execute(f->graph));
    return lobe_graph_describe(f->graph)->passes[0].state;
}

/// By number of the content; 0: the host may have changed it in between.
static const struct content_case {
    uint64_t content;
    lobe_pass_state expected;
} content_cases[] = {{0, LOBE_PASS_RUN},     {0, LOBE_PASS_RUN},    {7, LOBE_PASS_RUN},
                     {7, LOBE_PASS_SKIPPED}, {8, LOBE_PASS_RUN},    {0, LOBE_PASS_RUN},
                     {8, LOBE_PASS_RUN},     {8, LOBE_PASS_SKIPPED}};

static void an_image_is_read_again_where_its_content_changed(void **state) {
    fixture *f = *state;
    host_image image = green_picture(f);
    VkImageLayout layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    for (size_t i = 0; i < sizeof content_cases / sizeof *content_cases; i++) {
        lobe_graph_begin(f->graph);
        lobe_vulkan_image lent = lend(&image, layout);
        lent.content = content_cases[i].content;
        layout = lent.final_layout;
        const lobe_resource copy =
            lobe_graph_image(f->graph, &(lobe_image_description){.name = "copy",
                                                                 .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                                 .width = SIZE,
                                                                 .height = SIZE,
                                                                 .retained = true});
        assert_int_equal(copy_kept(f, lobe_graph_import_image(f->graph, &lent), copy),
                         content_cases[i].expected);
    }
    host_image_destroy(&f->host, &image);
}

static void a_frame_reads_the_hosts_image(void **state) {
    fixture *f = *state;
    host_image image = green_picture(f);
    lobe_graph_begin(f->graph);
    const lobe_vulkan_image lent = lend(&image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const lobe_resource source = lobe_graph_import_image(f->graph, &lent);
    lobe_graph_read_back(f->graph, source, (lobe_range){0});
    check(f, lobe_graph_execute(f->graph));
    const float *texels = lobe_graph_data(f->graph, source, NULL);
    assert_memory_equal(texels, ((float[]){0, 1, 0.25f, 1}), 16);
    host_image_destroy(&f->host, &image);
}

/// Returned in the final layout although no pass uses it.
static void an_unused_image_changes_its_layout(void **state) {
    fixture *f = *state;
    host_image image = green_picture(f);
    lobe_graph_begin(f->graph);
    lobe_vulkan_image lent = lend(&image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    lobe_graph_import_image(f->graph, &lent);
    check(f, lobe_graph_execute(f->graph));
    float texels[SIZE][SIZE][4];
    host_read(&f->host, &image, texels, sizeof texels);
    assert_float_equal(texels[0][0][1], 1, 0);
    host_image_destroy(&f->host, &image);
}

/// A layer of an array, on a level of its MIP chain; other parts stay as they were.
static void a_frame_draws_into_a_part_of_the_hosts_image(void **state) {
    enum { LAYERS = 3, LEVELS = 2 };
    fixture *f = *state;
    host_image image = host_image_create_array(&f->host, VK_FORMAT_R32G32B32A32_SFLOAT, 2 * SIZE,
                                               2 * SIZE, LAYERS, LEVELS, all_usages);
    VkCommandBuffer commands = host_begin(&f->host);
    for (image.layer = 0; image.layer < LAYERS; image.layer++)
        for (image.level = 0; image.level < LEVELS; image.level++)
            fill_green(&image, commands);
    host_finish(&f->host, commands);
    lobe_graph_begin(f->graph);
    lobe_resource parts[LAYERS];
    for (uint32_t layer = 1; layer < LAYERS; layer++) {
        lobe_vulkan_image lent = lend(&image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        lent.width = lent.height = SIZE;
        lent.first_layer = layer;
        lent.first_level = 1;
        parts[layer] = lobe_graph_import_image(f->graph, &lent);
    }
    draw_half(f, parts[1], LOBE_LOAD_KEEP, 0.5f);
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "fill");
    parts[2] = lobe_pass_fill(pass, parts[2], (lobe_range){0}, (float[]){0, 0, 3, 1});
    lobe_graph_read_back(f->graph, parts[2], (lobe_range){0});
    check(f, lobe_graph_execute(f->graph));
    assert_float_equal(((const float *)lobe_graph_data(f->graph, parts[2], NULL))[2], 3, 0);
    image.level = 1;
    image.layer = 1;
    expect(f, &image, 0.5f, 0.25f);
    image.layer = 2;
    expect_all(f, &image, 3);
    commands = host_begin(&f->host);
    for (image.layer = 0; image.layer < LAYERS; image.layer++)
        for (image.level = 0; image.level < (image.layer == 0 ? 2u : 1u); image.level++)
            host_barrier(commands, &image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    host_finish(&f->host, commands);
    image.layer = 0;
    image.level = 1;
    expect_all(f, &image, 0.25f);
    host_image_destroy(&f->host, &image);
}

static void displays_have_formats_too(void **state) {
    (void)state;
    assert_int_equal(lobe_vulkan_format(VK_FORMAT_B8G8R8A8_SRGB), LOBE_FORMAT_BGRA8_SRGB);
    assert_int_equal(lobe_vulkan_format(VK_FORMAT_B10G11R11_UFLOAT_PACK32),
                     LOBE_FORMAT_RG11B10_FLOAT);
    assert_int_equal(lobe_vulkan_format(VK_FORMAT_D32_SFLOAT), LOBE_FORMAT_D32_FLOAT);
    assert_int_equal(lobe_vulkan_format(VK_FORMAT_ASTC_4x4_SRGB_BLOCK), LOBE_FORMAT_NONE);
    assert_int_equal(lobe_vulkan_format(VK_FORMAT_UNDEFINED), LOBE_FORMAT_NONE);
}

static void assert_refused(fixture *f, lobe_result expected, const char *words) {
    log_recorder_start(&f->host.recorder);
    assert_int_equal(lobe_graph_execute(f->graph), expected);
    if (!strstr(f->host.recorder.last_error, words))
        fail_msg("%s", f->host.recorder.last_error);
    log_recorder_start(&f->host.recorder);
}

enum { PART = 512, OFFSET = 256 }; // bytes

/// The part of a buffer that frames use.
static lobe_vulkan_buffer lend_part(const host_buffer *buffer) {
    return (lobe_vulkan_buffer){.buffer = buffer->buffer,
                                .offset = OFFSET,
                                .size = PART,
                                .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT};
}

static void assert_words(fixture *f, lobe_resource resource, uint32_t first, uint32_t step) {
    size_t size = 0;
    const uint32_t *words = lobe_graph_data(f->graph, resource, &size);
    assert_int_equal(size, PART);
    for (uint32_t i = 0; i < PART / 4; i++)
        assert_int_equal(words[i], first + step * i);
}

/// What the host writes before, and what a frame writes for the next.
static void frames_read_and_write_the_hosts_buffer(void **state) {
    static const float filling[4] = {2};
    fixture *f = *state;
    uint32_t words[PART / 4], bits;
    for (uint32_t i = 0; i < PART / 4; i++)
        words[i] = 100 + 3 * i;
    host_buffer buffer =
        host_buffer_create(&f->host, OFFSET + 2 * PART,
                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    const lobe_vulkan_buffer lent = lend_part(&buffer);
    VkCommandBuffer commands = host_begin(&f->host);
    host_write(commands, &buffer, OFFSET, words, PART);
    host_write(commands, &buffer, OFFSET + PART, words, PART);
    lobe_graph_begin(f->graph);
    lobe_resource part = lobe_graph_import_host_buffer(f->graph, &lent);
    assert_int_equal(lobe_graph_buffer_size(f->graph, part), PART);
    lobe_graph_read_back(f->graph, part, (lobe_range){0});
    const lobe_vulkan_submission submission = {.commands = commands};
    assert_int_equal(lobe_graph_submit(f->graph, &submission), LOBE_OK);
    host_finish(&f->host, commands);
    assert_int_equal(lobe_graph_wait(f->graph), LOBE_OK);
    assert_words(f, part, 100, 3);
    lobe_graph_begin(f->graph);
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "fill");
    part = lobe_pass_fill(pass, lobe_graph_import_host_buffer(f->graph, &lent), (lobe_range){0},
                          filling);
    lobe_graph_output(f->graph, part);
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
    lobe_vulkan_buffer behind = lent;
    behind.offset += PART;
    lobe_graph_begin(f->graph);
    part = lobe_graph_import_host_buffer(f->graph, &lent);
    const lobe_resource rest = lobe_graph_import_host_buffer(f->graph, &behind);
    lobe_graph_read_back(f->graph, part, (lobe_range){0});
    lobe_graph_read_back(f->graph, rest, (lobe_range){0});
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
    memcpy(&bits, filling, sizeof bits);
    assert_words(f, part, bits, 0);
    assert_words(f, rest, 100, 3); // is not filled
    host_buffer_destroy(&f->host, &buffer);
}

static void a_buffer_is_read_again_where_its_content_changed(void **state) {
    fixture *f = *state;
    host_buffer buffer =
        host_buffer_create(&f->host, OFFSET + PART,
                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    for (size_t i = 0; i < sizeof content_cases / sizeof *content_cases; i++) {
        lobe_vulkan_buffer lent = lend_part(&buffer);
        lent.content = content_cases[i].content;
        lobe_graph_begin(f->graph);
        const lobe_resource copy = lobe_graph_buffer(
            f->graph, &(lobe_buffer_description){.name = "copy", .size = PART, .retained = true});
        assert_int_equal(copy_kept(f, lobe_graph_import_host_buffer(f->graph, &lent), copy),
                         content_cases[i].expected);
    }
    host_buffer_destroy(&f->host, &buffer);
}

static void assert_not_imported(fixture *f, const lobe_vulkan_buffer *buffer, const char *words) {
    lobe_graph_begin(f->graph);
    assert_int_equal(lobe_graph_import_host_buffer(f->graph, buffer).version, 0);
    if (!strstr(f->host.recorder.last_error, words))
        fail_msg("%s", f->host.recorder.last_error);
}

static void mistakes_with_buffers_are_named(void **state) {
    fixture *f = *state;
    host_buffer buffer =
        host_buffer_create(&f->host, OFFSET + PART, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    const lobe_vulkan_buffer whole = lend_part(&buffer);
    lobe_vulkan_buffer lent = whole;
    lent.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    lobe_graph_begin(f->graph);
    lobe_graph_read_back(f->graph, lobe_graph_import_host_buffer(f->graph, &lent), (lobe_range){0});
    assert_refused(f, LOBE_ERROR_GRAPH, "not created with the usage 'transfer source'");
    lent = whole;
    lent.offset = 1;
    assert_not_imported(f, &lent, "the offset 1 is no multiple of");
    lent.offset = whole.offset;
    lent.size = 0;
    assert_not_imported(f, &lent, "needs a handle and a size above 0");
    lobe_graph_begin(f->graph);
    lobe_graph_import_host_buffer(f->graph, &whole);
    assert_int_equal(lobe_graph_import_host_buffer(f->graph, &whole).version, 0);
    assert_non_null(strstr(f->host.recorder.last_error, "is imported twice"));
    host_buffer_destroy(&f->host, &buffer);
}

static void mistakes_are_named(void **state) {
    fixture *f = *state;
    host_image image = picture(f);
    lobe_vulkan_image lent = lend(&image, VK_IMAGE_LAYOUT_UNDEFINED);
    lent.name = "canvas";
    // No content to keep.
    lobe_graph_begin(f->graph);
    draw_half(f, lobe_graph_import_image(f->graph, &lent), LOBE_LOAD_KEEP, 0.5f);
    assert_refused(f, LOBE_ERROR_GRAPH, "canvas");
    // Not created with the usage.
    lent.usage &= ~(VkImageUsageFlags)VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    lobe_graph_begin(f->graph);
    draw_half(f, lobe_graph_import_image(f->graph, &lent), LOBE_LOAD_CLEAR, 0.5f);
    assert_refused(f, LOBE_ERROR_GRAPH,
                   "'canvas' was not created with the usage 'colour attachment'");
    // Twice.
    lobe_graph_begin(f->graph);
    lobe_graph_import_image(f->graph, &lent);
    assert_int_equal(lobe_graph_import_image(f->graph, &lent).version, 0);
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_ERROR_GRAPH);
    assert_non_null(strstr(f->host.recorder.last_error, "twice"));
    // Twice, in part.
    lent.layers = 2;
    lobe_graph_begin(f->graph);
    lobe_graph_import_image(f->graph, &lent);
    lent.first_layer = 1;
    assert_int_equal(lobe_graph_import_image(f->graph, &lent).version, 0);
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_ERROR_GRAPH);
    // Of an unknown format.
    lent.format = VK_FORMAT_ASTC_4x4_SRGB_BLOCK;
    lobe_graph_begin(f->graph);
    lobe_graph_import_image(f->graph, &lent);
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_ERROR_UNSUPPORTED);
    // No image.
    lent.image = VK_NULL_HANDLE;
    lobe_graph_begin(f->graph);
    lobe_graph_import_image(f->graph, &lent);
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_ERROR_GRAPH);
    host_image_destroy(&f->host, &image);
}

// ---------------------------------------------------------------------------------------------
// Semaphores

static uint64_t value_of(const fixture *f, VkSemaphore semaphore) {
    uint64_t value;
    assert_int_equal(vkGetSemaphoreCounterValue(f->host.vulkan.device, semaphore, &value),
                     VK_SUCCESS);
    return value;
}

static void wait_for(const fixture *f, VkSemaphore semaphore, uint64_t value) {
    const VkSemaphoreWaitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                      .semaphoreCount = 1,
                                      .pSemaphores = &semaphore,
                                      .pValues = &value};
    assert_int_equal(vkWaitSemaphores(f->host.vulkan.device, &wait, UINT64_MAX), VK_SUCCESS);
}

static void a_frame_waits_for_the_host_and_tells_it(void **state) {
    fixture *f = *state;
    host_image image = picture(f);
    VkSemaphore timeline = host_semaphore(&f->host, true);
    lobe_graph_begin(f->graph);
    lobe_vulkan_image lent = lend(&image, VK_IMAGE_LAYOUT_UNDEFINED);
    lobe_resource drawn =
        draw_half(f, lobe_graph_import_image(f->graph, &lent), LOBE_LOAD_CLEAR, 0.5f);
    (void)drawn;
    const lobe_vulkan_semaphore wait = {timeline, 3, 0}, signal = {timeline, 5, 0};
    const lobe_vulkan_submission submission = {
        .waits = &wait, .wait_count = 1, .signals = &signal, .signal_count = 1};
    check(f, lobe_graph_submit(f->graph, &submission));
    assert_int_equal(value_of(f, timeline), 0);
    const VkSemaphoreSignalInfo go = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO, .semaphore = timeline, .value = 3};
    assert_int_equal(vkSignalSemaphore(f->host.vulkan.device, &go), VK_SUCCESS);
    wait_for(f, timeline, 5);
    expect(f, &image, 0.5f, 1);
    check(f, lobe_graph_wait(f->graph));
    vkDestroySemaphore(f->host.vulkan.device, timeline, NULL);
    host_image_destroy(&f->host, &image);
}

static void read_back_is_there_after_waiting(void **state) {
    fixture *f = *state;
    lobe_graph_begin(f->graph);
    lobe_resource image = lobe_graph_image(
        f->graph,
        &(lobe_image_description){
            .name = "own", .format = LOBE_FORMAT_RGBA32_FLOAT, .width = SIZE, .height = SIZE});
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "fill");
    image = lobe_pass_fill(pass, image, (lobe_range){0}, (float[]){7, 0, 0, 0});
    lobe_graph_read_back(f->graph, image, (lobe_range){0});
    check(f, lobe_graph_submit(f->graph, &(lobe_vulkan_submission){0}));
    assert_null(lobe_graph_data(f->graph, image, NULL));
    check(f, lobe_graph_wait(f->graph));
    assert_float_equal(*(const float *)lobe_graph_data(f->graph, image, NULL), 7, 0);
    assert_true(lobe_graph_describe(f->graph)->milliseconds > 0);
    check(f, lobe_graph_wait(f->graph));
    assert_int_equal(lobe_graph_submit(f->graph, &(lobe_vulkan_submission){0}), LOBE_ERROR_GRAPH);
}

static void too_many_semaphores_are_refused(void **state) {
    fixture *f = *state;
    VkCommandBuffer commands = host_begin(&f->host);
    lobe_vulkan_submission submission = {.commands = commands, .wait_count = 1};
    lobe_graph_begin(f->graph);
    assert_int_equal(lobe_graph_submit(f->graph, &submission), LOBE_ERROR_INVALID_ARGUMENT);
    submission = (lobe_vulkan_submission){.signal_count = LOBE_VULKAN_MAXIMUM_SEMAPHORES + 1};
    lobe_graph_begin(f->graph);
    assert_int_equal(lobe_graph_submit(f->graph, &submission), LOBE_ERROR_INVALID_ARGUMENT);
    host_finish(&f->host, commands);
}

// ---------------------------------------------------------------------------------------------
// The host's command buffer

static void a_frame_is_recorded_between_the_hosts_commands(void **state) {
    fixture *f = *state;
    host_image image = picture(f);
    VkCommandBuffer commands = host_begin(&f->host);
    fill_green(&image, commands);
    lobe_graph_begin(f->graph);
    lobe_vulkan_image lent = lend(&image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    lent.final_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    lent.final_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    lent.final_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    draw_half(f, lobe_graph_import_image(f->graph, &lent), LOBE_LOAD_KEEP, 0.5f);
    check(f, lobe_graph_submit(f->graph, &(lobe_vulkan_submission){.commands = commands}));
    // Without a barrier by the host: one column of texels is overwritten.
    const VkImageSubresourceLayers layers = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageCopy copy = {layers, {0, 0, 0}, layers, {SIZE - 2, 0, 0}, {1, SIZE, 1}};
    host_image white = picture(f);
    host_barrier(commands, &white, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    host_clear(commands, &white, (float[]){0, 0, 9, 1});
    host_barrier(commands, &white, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                 VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImage(commands, white.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image.image,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    host_barrier(commands, &image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                 VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    host_finish(&f->host, commands);
    expect(f, &image, 0.5f, 9);
    check(f, lobe_graph_wait(f->graph));
    assert_true(lobe_graph_describe(f->graph)->milliseconds > 0);
    host_image_destroy(&f->host, &white);
    host_image_destroy(&f->host, &image);
}

// ---------------------------------------------------------------------------------------------
// Frames in flight

/// A frame that passes its colour through an upload and a transient image, whose size changes every
/// third frame, so that memory is replaced while frames are in flight.
static void declare_frame(fixture *f, const host_image *target, uint32_t number) {
    const uint32_t extent = SIZE << number / 3 % 2;
    lobe_graph_begin(f->graph);
    lobe_vulkan_image lent = lend(target, VK_IMAGE_LAYOUT_UNDEFINED);
    lobe_resource image = lobe_graph_import_image(f->graph, &lent);
    lobe_resource between =
        lobe_graph_image(f->graph, &(lobe_image_description){.name = "between",
                                                             .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                             .width = extent,
                                                             .height = extent});
    between = draw_half(f, between, LOBE_LOAD_CLEAR, (float)number);
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "fill");
    float colour[4] = {(float)number, 0, 0, 0};
    image = lobe_pass_fill(pass, image, (lobe_range){0}, colour);
    if (extent == SIZE) {
        pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "copy");
        image = lobe_pass_copy(pass, between, (lobe_range){0}, image, (lobe_range){0});
    }
    lobe_graph_output(f->graph, image);
}

static void frames_in_flight_keep_apart(void **state) {
    enum { FRAMES = 12 };
    fixture *f = *state;
    host_image images[FRAMES];
    for (uint32_t count = 1; count <= 3; count++) {
        lobe_graph_set_frames_in_flight(f->graph, count);
        for (uint32_t i = 0; i < FRAMES; i++) {
            images[i] = picture(f);
            declare_frame(f, &images[i], i);
            check(f, lobe_graph_submit(f->graph, &(lobe_vulkan_submission){0}));
        }
        check(f, lobe_graph_wait(f->graph));
        for (uint32_t i = 0; i < FRAMES; i++) {
            float texels[SIZE][SIZE][4];
            host_read(&f->host, &images[i], texels, sizeof texels);
            assert_float_equal(texels[SIZE - 2][1][0], (float)i, 0);
            host_image_destroy(&f->host, &images[i]);
        }
    }
}

/// Two frames are submitted; the second does not begin before the first may.
static void a_second_frame_is_submitted_while_the_first_waits(void **state) {
    fixture *f = *state;
    host_image first = picture(f), second = picture(f);
    VkSemaphore timeline = host_semaphore(&f->host, true);
    const lobe_vulkan_semaphore wait = {timeline, 1, 0}, signal = {timeline, 2, 0};
    lobe_graph_set_frames_in_flight(f->graph, 2);
    declare_frame(f, &first, 1);
    check(f,
          lobe_graph_submit(f->graph, &(lobe_vulkan_submission){.waits = &wait, .wait_count = 1}));
    declare_frame(f, &second, 2);
    check(f, lobe_graph_submit(f->graph,
                               &(lobe_vulkan_submission){.signals = &signal, .signal_count = 1}));
    assert_int_equal(value_of(f, timeline), 0);
    const VkSemaphoreSignalInfo go = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO, .semaphore = timeline, .value = 1};
    assert_int_equal(vkSignalSemaphore(f->host.vulkan.device, &go), VK_SUCCESS);
    wait_for(f, timeline, 2);
    float texels[SIZE][SIZE][4];
    host_read(&f->host, &first, texels, sizeof texels);
    assert_float_equal(texels[SIZE - 2][1][0], 1, 0);
    host_read(&f->host, &second, texels, sizeof texels);
    assert_float_equal(texels[SIZE - 2][1][0], 2, 0);
    lobe_graph_destroy(&f->graph);
    vkDestroySemaphore(f->host.vulkan.device, timeline, NULL);
    host_image_destroy(&f->host, &first);
    host_image_destroy(&f->host, &second);
}

// ---------------------------------------------------------------------------------------------
// Shaders

static const engine_shader_code *test_shader(const char *name) {
    for (size_t i = 0; i < engine_test_shaders_count; i++)
        if (!strcmp(engine_test_shaders[i].name, name))
            return &engine_test_shaders[i];
    fail_msg("no shader '%s'", name);
    return NULL;
}

static float run_count(fixture *f, const char *shader) {
    const struct {
        float factor;
        uint32_t count;
    } constants = {3, 4};
    lobe_graph_begin(f->graph);
    lobe_resource target =
        lobe_graph_buffer(f->graph, &(lobe_buffer_description){.name = "target", .size = 16});
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_COMPUTE, "own");
    target = lobe_pass_write(pass, &(lobe_binding){.name = "target_block", .resource = target});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = shader,
                                              .threads = {4},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    lobe_graph_read_back(f->graph, target, (lobe_range){0});
    check(f, lobe_graph_execute(f->graph));
    return ((const float *)lobe_graph_data(f->graph, target, NULL))[2];
}

static void hosts_add_shaders(void **state) {
    fixture *f = *state;
    const engine_shader_code *code = test_shader("graph_count.comp");
    lobe_shader shader = {"own.comp", code->words, code->size};
    check(f, lobe_device_add_shader(f->device, &shader));
    assert_float_equal(run_count(f, "own.comp"), 6, 0);
    // A shader of the same name replaces it, a broken one does not.
    check(f, lobe_device_add_shader(f->device, &shader));
    assert_float_equal(run_count(f, "own.comp"), 6, 0);
    static const uint32_t nonsense[8] = {1, 2, 3};
    shader = (lobe_shader){"own.comp", nonsense, sizeof nonsense};
    assert_int_equal(lobe_device_add_shader(f->device, &shader), LOBE_ERROR_SHADER);
    assert_int_equal(f->host.recorder.errors, 1);
    assert_non_null(strstr(f->host.recorder.last_error, "own.comp"));
    shader.size = 7;
    assert_int_equal(lobe_device_add_shader(f->device, &shader), LOBE_ERROR_INVALID_ARGUMENT);
    shader = (lobe_shader){.words = code->words, .size = code->size};
    assert_int_equal(lobe_device_add_shader(f->device, &shader), LOBE_ERROR_INVALID_ARGUMENT);
    assert_float_equal(run_count(f, "own.comp"), 6, 0);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, open_fixture, close_fixture)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_frame_draws_into_the_hosts_image),
        TEST(what_the_host_drew_is_kept),
        TEST(a_frame_reads_the_hosts_image),
        TEST(an_image_is_read_again_where_its_content_changed),
        TEST(an_unused_image_changes_its_layout),
        TEST(a_frame_draws_into_a_part_of_the_hosts_image),
        cmocka_unit_test(displays_have_formats_too),
        TEST(mistakes_are_named),
        TEST(frames_read_and_write_the_hosts_buffer),
        TEST(a_buffer_is_read_again_where_its_content_changed),
        TEST(mistakes_with_buffers_are_named),
        TEST(a_frame_waits_for_the_host_and_tells_it),
        TEST(read_back_is_there_after_waiting),
        TEST(too_many_semaphores_are_refused),
        TEST(a_frame_is_recorded_between_the_hosts_commands),
        TEST(frames_in_flight_keep_apart),
        TEST(a_second_frame_is_submitted_while_the_first_waits),
        TEST(hosts_add_shaders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
