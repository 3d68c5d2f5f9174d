// Frames that are not waited for, of colours that begin and cease to go with normals: each picture
// is that of its own texels, nobody waits, and a map that is not needed gives its memory back.

#include "tests/passes/support/fixture.h"

#include <stdlib.h>
#include <string.h>

#include "tests/engine/support/host_device.h"
#include "tests/engine/support/vulkan_faults.h"
#include "tests/passes/maps/colours/colour_scene.h"
#include "tests/passes/support/picture.h"

enum { EXTENT = 4, FLIGHT = 2, FLOATS = 4 * EXTENT * EXTENT };

static const VkImageUsageFlags usage =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;

typedef struct host {
    host_device device;
    lobe_device *lobe;
    lobe_renderer *renderer;
    lobe_scene *scene;
    host_image pictures[FLIGHT];
    uint32_t frame;
} host;

static int waits(void) {
    return vulkan_calls("vkWaitSemaphores") + vulkan_calls("vkDeviceWaitIdle") +
           vulkan_calls("vkQueueWaitIdle");
}

static lobe_renderer *renderer_of(host *h, const lobe_scene *scene) {
    lobe_renderer *renderer;
    assert_int_equal(lobe_renderer_create(h->lobe, &h->device.recorder.host, &renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    return renderer;
}

static host *start(const colour_way *way) {
    host *h = calloc(1, sizeof *h);
    faults.paused = true; // nothing fails by itself
    host_device_open(&h->device);
    h->lobe = host_device_import(&h->device);
    h->scene = colour_scene(way);
    h->renderer = renderer_of(h, h->scene);
    for (int i = 0; i < FLIGHT; i++)
        h->pictures[i] =
            host_image_create(&h->device, VK_FORMAT_R32G32B32A32_SFLOAT, EXTENT, EXTENT, usage);
    return h;
}

static void stop(host *h) {
    assert_int_equal(vkDeviceWaitIdle(h->device.vulkan.device), VK_SUCCESS);
    for (int i = 0; i < FLIGHT; i++)
        host_image_destroy(&h->device, &h->pictures[i]);
    lobe_renderer_destroy(&h->renderer);
    lobe_scene_destroy(&h->scene);
    assert_int_equal(h->device.recorder.errors, 0);
    lobe_device_destroy(&h->lobe);
    host_device_close(&h->device);
    free(h);
}

static lobe_render_parameters toksvig(void) {
    return (lobe_render_parameters){
        .filter = filter_named("toksvig"), .width = EXTENT, .height = EXTENT};
}

/// The test has waited for the frames before, so that lobe has no reason to. Returns how often it
/// waited.
static int submit(host *h) {
    const host_image *picture = &h->pictures[h->frame++ % FLIGHT];
    const lobe_vulkan_image lent = {.image = picture->image,
                                    .format = picture->format,
                                    .width = EXTENT,
                                    .height = EXTENT,
                                    .usage = usage,
                                    .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const lobe_render_target target = {.radiance = &lent};
    const lobe_vulkan_submission submission = {0};
    lobe_render_parameters wanted = toksvig();
    lobe_frame frame;
    wanted.host = (lobe_render_host){
        .target = &target, .submission = &submission, .frames_in_flight = FLIGHT};
    assert_int_equal(vkDeviceWaitIdle(h->device.vulkan.device), VK_SUCCESS);
    const int before = waits();
    assert_int_equal(lobe_renderer_render(h->renderer, &wanted, &frame), LOBE_OK);
    lobe_frame_free(&frame);
    return waits() - before;
}

static void draw_many(host *h, int count) {
    for (int n = 0; n < count; n++) {
        const int waited = submit(h);
        assert_true(h->frame == 1 || waited == 0);
    }
}

// ---------------------------------------------------------------------------------------------
// Memory

static uint64_t used_bytes(const host *h) {
    lobe_device_memory memory;
    lobe_device_memory_query(h->lobe, &memory);
    return memory.used_bytes;
}

/// Of half the extent, in half floats, without its smaller levels.
static uint64_t map_bytes(uint32_t layers) {
    const colour_way *way = &colours_of_no_normals;
    return (uint64_t)way->width * way->height / 4 * 8 * layers;
}

/// Against a host whose renderer was told before its first frame.
static void a_map_that_is_not_needed_goes(void **state) {
    host *late = start(&colours_of_no_normals), *known = start(&colours_of_no_normals);
    const lobe_render_parameters wanted = toksvig();
    (void)state;
    assert_int_equal(lobe_renderer_prepare(known->renderer, &wanted), LOBE_OK);
    draw_many(late, 1);
    const uint64_t first = used_bytes(late);
    draw_many(late, 5);
    draw_many(known, 6);
    assert_true(first >= used_bytes(known) + map_bytes(1));
    assert_true(used_bytes(late) <= used_bytes(known) + 1024);
    stop(late);
    stop(known);
}

// ---------------------------------------------------------------------------------------------
// Pictures

/// Of a renderer that never saw other texels, and waits.
static void fresh_picture(host *h, float texels[FLOATS]) {
    lobe_renderer *fresh = renderer_of(h, h->scene);
    const lobe_render_parameters wanted = toksvig();
    lobe_frame frame;
    assert_int_equal(lobe_renderer_render(fresh, &wanted, &frame), LOBE_OK);
    memcpy(texels, frame.radiance.texels, FLOATS * sizeof *texels);
    lobe_frame_free(&frame);
    lobe_renderer_destroy(&fresh);
}

static void check_picture(host *h) {
    float expected[FLOATS], texels[FLOATS];
    assert_int_equal(submit(h), 0);
    host_read(&h->device, &h->pictures[(h->frame - 1) % FLIGHT], texels, sizeof texels);
    fresh_picture(h, expected);
    assert_memory_equal(texels, expected, sizeof texels);
}

/// For one frame, which nobody can answer in time, and for so many that answers come back.
static void each_picture_is_of_its_own_texels(void **state) {
    static const uint32_t colours = COLOUR_SCENE_COLOURS;
    static const int lasting[] = {1, 2, 1, 1, 4, 4, 1, 4};
    const lobe_scene_changes texels = {.images = &colours, .image_count = 1};
    host *h = start(&colours_of_no_normals);
    (void)state;
    draw_many(h, 4);
    for (size_t n = 0; n < sizeof lasting / sizeof *lasting; n++) {
        colour_scene_recolour(h->scene, n % 2 ? &colours_of_no_normals : &colours_of_normals);
        assert_int_equal(lobe_renderer_update_scene(h->renderer, &texels), LOBE_OK);
        for (int i = 0; i < lasting[n]; i++)
            check_picture(h);
    }
    stop(h);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_map_that_is_not_needed_goes),
        cmocka_unit_test(each_picture_is_of_its_own_texels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
