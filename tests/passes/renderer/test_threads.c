// Renderers in several threads on one device share its memory, queue, shaders and pipelines, and
// pairs of them what they have of their scenes: their pictures equal those of a single thread, and
// no pipeline is created twice.

#include "tests/passes/support/fixture.h"

#include <pthread.h>

#include "tests/engine/support/vulkan_faults.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { THREADS = 4, FRAMES = 3, EXTENT = 8 };

typedef struct worker {
    lobe_device *device;
    const lobe_host *host;
    int number;
    uint64_t pictures[FRAMES];
    bool failed;
} worker;

static lobe_scene *scene_of(int number) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    if (number % 2)
        lobe_material_default(&material);
    material.normal_map =
        scene_add_map(scene, random_normal_map(64, 64, 0.4, 40 + (uint64_t)(number % 2)));
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.2, 1, 0.1 * number}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// Draws frames with its own renderer, uploading the scene for each, and for every other one its
/// map once more. Only the thread that runs the test may assert.
static void *work(void *user) {
    static const char *const filters[THREADS] = {"lobes", "toksvig", "lobes", "toksvig"};
    static const uint32_t map = 0;
    worker *self = user;
    lobe_renderer *renderer = NULL;
    lobe_scene *scene = scene_of(self->number);
    const lobe_filter *filter;
    lobe_filter_find(filters[self->number], NULL, &filter);
    lobe_result result = lobe_renderer_create(self->device, self->host, &renderer);
    for (int n = 0; result == LOBE_OK && n < FRAMES; n++) {
        lobe_frame frame = {0};
        result = lobe_renderer_set_scene(renderer, scene);
        if (result == LOBE_OK && n % 2)
            result = lobe_renderer_update_scene(
                renderer, &(lobe_scene_changes){.images = &map, .image_count = 1});
        if (result == LOBE_OK)
            result = lobe_renderer_render(
                renderer,
                &(lobe_render_parameters){.filter = filter, .width = EXTENT, .height = EXTENT},
                &frame);
        if (result == LOBE_OK)
            self->pictures[n] = image_hash(&frame.radiance);
        lobe_frame_free(&frame);
    }
    self->failed = result != LOBE_OK;
    lobe_renderer_destroy(&renderer);
    lobe_scene_destroy(&scene);
    return NULL;
}

/// The number of pipelines they create.
static int work_at_once(fixture *f, worker workers[THREADS]) {
    pthread_t threads[THREADS];
    faults.pipelines = 0;
    for (int n = 0; n < THREADS; n++) {
        workers[n] = (worker){.device = f->device, .host = &f->host, .number = n};
        assert_int_equal(pthread_create(&threads[n], NULL, work, &workers[n]), 0);
    }
    for (int n = 0; n < THREADS; n++)
        assert_int_equal(pthread_join(threads[n], NULL), 0);
    return faults.pipelines;
}

static void threads_draw_what_one_alone_draws(void **state) {
    fixture *f = *state;
    worker workers[THREADS];
    faults.paused = true; // nothing should fail
    const int made = work_at_once(f, workers);
    lobe_device *other = fixture_device(f, (lobe_device_parameters){0});
    faults.pipelines = 0;
    for (int n = 0; n < THREADS; n++) {
        worker alone = {.device = other, .host = &f->host, .number = n};
        work(&alone);
        assert_false(workers[n].failed);
        assert_false(alone.failed);
        for (int frame = 0; frame < FRAMES; frame++)
            assert_true(workers[n].pictures[frame] == alone.pictures[0]);
    }
    assert_int_equal(made, faults.pipelines);
    lobe_device_destroy(&other);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
    // All of them returned their memory.
    lobe_device_memory memory;
    lobe_device_memory_query(f->device, &memory);
    assert_int_equal(memory.used_bytes, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_draw_what_one_alone_draws),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
