// Every Vulkan call that a renderer makes fails once, out of device memory: our call that needed it
// returns that error and logs one line, and the same renderer then draws the scene.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include "tests/engine/support/host_device.h"
#include "tests/engine/support/vulkan_faults.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 8 };

static lobe_scene *small_scene(uint32_t map_extent) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.normal_map = scene_add_map(scene, random_normal_map(map_extent, map_extent, 0.4, 90));
    scene_end_with_square(scene, &material);
    return scene;
}

// ---------------------------------------------------------------------------------------------
// Pictures

/// Where pictures are drawn.
typedef struct way {
    fixture *f;
    lobe_scene *scene;
    lobe_image other; ///< in place of the scene's map
    bool into_image;  ///< into the host's image, with two frames in flight; otherwise delivered
    host_device host; ///< the same device, as a host has it
    host_image image;
} way;

static lobe_result deliver(way *w, uint64_t *hash) {
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(
        w->f->renderer, &(lobe_render_parameters){.width = EXTENT, .height = EXTENT}, &frame);
    *hash = result == LOBE_OK ? image_hash(&frame.radiance) : 0;
    lobe_frame_free(&frame);
    return result;
}

static lobe_result submit(way *w) {
    const lobe_vulkan_image lent = {.image = w->image.image,
                                    .format = w->image.format,
                                    .width = EXTENT,
                                    .height = EXTENT,
                                    .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                             VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                    .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const lobe_render_target target = {.radiance = &lent};
    const lobe_vulkan_submission submission = {0};
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(
        w->f->renderer,
        &(lobe_render_parameters){
            .host = {.target = &target, .submission = &submission, .frames_in_flight = 2}},
        &frame);
    lobe_frame_free(&frame);
    return result;
}

/// Two frames in a row, and the image's contents afterwards.
static lobe_result draw_into_image(way *w, uint64_t *hash) {
    float texels[EXTENT * EXTENT * 4];
    *hash = 0;
    lobe_result result = submit(w);
    result = result ? result : submit(w);
    result = result ? result : lobe_graph_wait(lobe_renderer_graph(w->f->renderer));
    if (result != LOBE_OK)
        return result;
    host_read(&w->host, &w->image, texels, sizeof texels);
    *hash = image_hash(&(lobe_image){LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT, texels});
    return LOBE_OK;
}

static lobe_result draw_hash(way *w, uint64_t *hash) {
    return w->into_image ? draw_into_image(w, hash) : deliver(w, hash);
}

/// A renderer, a scene, a picture; another map, and a picture of that.
static lobe_result work(way *w, uint64_t *hash) {
    static const uint32_t first = 0;
    fixture *f = w->f;
    lobe_result result = lobe_renderer_create(f->device, &f->host, &f->renderer);
    result = result ? result : lobe_renderer_set_scene(f->renderer, w->scene);
    result = result ? result : draw_hash(w, hash);
    if (result != LOBE_OK)
        return result;
    lobe_image was = w->scene->images[0].image;
    w->scene->images[0].image = w->other;
    result = lobe_renderer_update_scene(f->renderer,
                                        &(lobe_scene_changes){.images = &first, .image_count = 1});
    result = result ? result : draw_hash(w, hash);
    w->scene->images[0].image = was;
    return result;
}

// ---------------------------------------------------------------------------------------------
// Faults

/// Destruction waits, and destroys in any case.
static bool is_in_vain(const char *function) {
    return strcmp(function, "vkWaitSemaphores") == 0 || strcmp(function, "vkQueueSubmit2") == 0;
}

/// Of memory that content passes through, less does too.
static bool has_another_way(const char *function) {
    static const char *const functions[] = {"vkAllocateMemory", "vkBindBufferMemory",
                                            "vkCreateBuffer", "vkMapMemory"};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (strcmp(function, functions[i]) == 0)
            return true;
    return false;
}

/// `first`, `second`: the picture of the scene, and of the changed one.
static void check_fault(way *w, uint64_t first, uint64_t second) {
    fixture *f = w->f;
    uint64_t hash;
    faults.calls = 0;
    faults.failed = NULL;
    fixture_forget_messages(f);
    lobe_result result = work(w, &hash);
    const bool in_vain = result == LOBE_OK && is_in_vain(faults.failed);
    const bool went_on = result == LOBE_OK && has_another_way(faults.failed);
    if ((result != LOBE_ERROR_OUT_OF_DEVICE_MEMORY && !in_vain && !went_on) ||
        f->errors != !went_on || (result == LOBE_OK && hash != second))
        fail_msg("call %d, %s: %s, %u lines, the last '%s'", faults.failing, faults.failed,
                 lobe_result_name(result), f->errors, f->error);
    if (!f->renderer)
        return;
    result = lobe_renderer_set_scene(f->renderer, w->scene);
    result = result ? result : draw_hash(w, &hash);
    if (result != LOBE_OK || hash != first)
        fail_msg("call %d, %s: the picture after it is another (%s)", faults.failing, faults.failed,
                 f->error);
}

static void check_each_call(way *w) {
    fixture *f = w->f;
    uint64_t first, second;
    lobe_device_memory memory;
    // Creates what the device keeps, above all pipelines.
    assert_int_equal(work(w, &second), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, w->scene), LOBE_OK);
    assert_int_equal(draw_hash(w, &first), LOBE_OK);
    assert_true(first != second);
    lobe_renderer_destroy(&f->renderer);
    const int kept = faults.alive;
    faults.calls = 0;
    assert_int_equal(work(w, &second), LOBE_OK);
    const int during = faults.calls;
    lobe_renderer_destroy(&f->renderer);
    assert_true(during > 60);
    faults.fault = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    for (faults.failing = 1; faults.failing <= during; faults.failing++) {
        check_fault(w, first, second);
        lobe_renderer_destroy(&f->renderer);
        assert_int_equal(faults.alive, kept);
        lobe_device_memory_query(f->device, &memory);
        assert_int_equal(memory.used_bytes, 0);
    }
    faults.failing = 0;
}

static void open_way(way *w, fixture *f) {
    *w = (way){.f = f, .scene = small_scene(8), .other = random_normal_map(16, 4, 0.4, 91)};
    lobe_renderer_destroy(&f->renderer);
    lobe_graph_destroy(&f->graph);
}

static void close_way(way *w) {
    lobe_image_free(&w->other);
    lobe_scene_destroy(&w->scene);
}

static void each_call_fails_once(void **state) {
    way w;
    open_way(&w, *state);
    check_each_call(&w);
    close_way(&w);
}

static void each_call_fails_once_with_an_image_of_the_host(void **state) {
    way w;
    open_way(&w, *state);
    w.into_image = true;
    lobe_vulkan_export_device(w.f->device, &w.host.vulkan);
    const VkDevice device = w.host.vulkan.device;
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = w.host.vulkan.queue_family};
    assert_int_equal(vkCreateCommandPool(device, &pool, NULL, &w.host.pool), VK_SUCCESS);
    w.image =
        host_image_create(&w.host, VK_FORMAT_R32G32B32A32_SFLOAT, EXTENT, EXTENT,
                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    check_each_call(&w);
    host_image_destroy(&w.host, &w.image);
    vkDestroyCommandPool(device, w.host.pool, NULL);
    close_way(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_call_fails_once),
        cmocka_unit_test(each_call_fails_once_with_an_image_of_the_host),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
