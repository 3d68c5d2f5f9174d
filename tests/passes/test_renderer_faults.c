// Every call to Vulkan that a renderer makes fails once, for want of device memory: the call of
// ours that needed it says so by its code and one line, and the same renderer goes on to draw the
// scene.

#include "tests/passes/fixture.h"

#include <string.h>

#include "tests/engine/vulkan_faults.h"
#include "tests/passes/picture.h"
#include "tests/passes/scene_builder.h"

enum { EXTENT = 8 };

static lobe_scene *small_scene(uint32_t map_extent) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.normal_map = scene_add_map(scene, random_normal_map(map_extent, map_extent, 0.4, 90));
    scene_add_square(scene, &material, 1, NULL);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

static lobe_result draw_hash(fixture *f, uint64_t *hash) {
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(
        f->renderer, &(lobe_render_parameters){.width = EXTENT, .height = EXTENT}, &frame);
    *hash = result == LOBE_OK ? image_hash(&frame.radiance) : 0;
    lobe_frame_free(&frame);
    return result;
}

/// A renderer, a scene, a frame; another map, and a frame of that.
static lobe_result work(fixture *f, lobe_scene *scene, lobe_image *other, uint64_t *hash) {
    static const uint32_t first = 0;
    lobe_result result = lobe_renderer_create(f->device, &f->log, &f->renderer);
    result = result ? result : lobe_renderer_set_scene(f->renderer, scene);
    result = result ? result : draw_hash(f, hash);
    if (result != LOBE_OK)
        return result;
    lobe_image was = scene->images[0].image;
    scene->images[0].image = *other;
    result = lobe_renderer_update_scene(f->renderer,
                                        &(lobe_scene_changes){.images = &first, .image_count = 1});
    result = result ? result : draw_hash(f, hash);
    scene->images[0].image = was;
    return result;
}

static void check_fault(fixture *f, lobe_scene *scene, lobe_image *other, uint64_t expected) {
    uint64_t hash;
    faults.calls = 0;
    faults.failed = NULL;
    fixture_forget_messages(f);
    lobe_result result = work(f, scene, other, &hash);
    // What is destroyed is waited for, and destroyed in any case.
    bool in_vain = result == LOBE_OK && strcmp(faults.failed, "vkWaitSemaphores") == 0;
    if ((result != LOBE_ERROR_OUT_OF_DEVICE_MEMORY && !in_vain) || f->errors != 1)
        fail_msg("call %d, %s: %s, %u lines, the last '%s'", faults.failing, faults.failed,
                 lobe_result_name(result), f->errors, f->error);
    if (!f->renderer)
        return;
    result = lobe_renderer_set_scene(f->renderer, scene);
    result = result ? result : draw_hash(f, &hash);
    if (result != LOBE_OK || hash != expected)
        fail_msg("call %d, %s: the picture after it is another (%s)", faults.failing, faults.failed,
                 f->error);
}

static void each_call_fails_once(void **state) {
    fixture *f = *state;
    lobe_scene *scene = small_scene(8);
    lobe_image other = random_normal_map(16, 4, 0.4, 91);
    uint64_t first, hash;
    lobe_device_memory memory;
    lobe_renderer_destroy(&f->renderer);
    lobe_graph_destroy(&f->graph);
    // What the device keeps, pipelines above all, is made here.
    assert_int_equal(work(f, scene, &other, &hash), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_int_equal(draw_hash(f, &first), LOBE_OK);
    assert_true(first != hash);
    lobe_renderer_destroy(&f->renderer);
    const int kept = faults.alive;
    faults.calls = 0;
    assert_int_equal(work(f, scene, &other, &hash), LOBE_OK);
    const int during = faults.calls;
    lobe_renderer_destroy(&f->renderer);
    assert_true(during > 60);
    faults.fault = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    for (faults.failing = 1; faults.failing <= during; faults.failing++) {
        check_fault(f, scene, &other, first);
        lobe_renderer_destroy(&f->renderer);
        assert_int_equal(faults.alive, kept);
        lobe_device_memory_query(f->device, &memory);
        assert_int_equal(memory.used_bytes, 0);
    }
    faults.failing = 0;
    lobe_image_free(&other);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_call_fails_once),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
