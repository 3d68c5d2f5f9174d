// Pipelines that are made before the frames that need them, in the same thread or in another while
// frames go on: frames then make none.

#include "tests/passes/support/fixture.h"

#include <lobe/preparation.h>

#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <string.h>
#include <time.h>

#include "scenes/scene/scene.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/host_device.h"
#include "tests/engine/support/vulkan_faults.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 8 };

static lobe_material bumpy_material(lobe_scene *scene, uint64_t seed) {
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 0.5f;
    material.roughness = 0.4f;
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.4, seed));
    material.metallic_roughness_map = scene_add_map(scene, random_map(16, 16, 0.3, 0.9, seed + 1));
    return material;
}

static void add_light(lobe_scene *scene) {
    scene_add_sun(scene, (double[]){0.2, 1, 0.1}, 2);
    scene_look_down(scene, 2);
}

/// Both models, and a mask.
static lobe_scene *rich_scene(void) {
    lobe_scene *scene = scene_begin();
    const float left[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, -0.5f, 0, 0, 1};
    const float right[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0, 0, 1};
    lobe_material material = bumpy_material(scene, 70);
    scene_add_square(scene, &material, 1, left);
    material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.4, 72));
    material.base_colour_map = scene_add_map(scene, random_map(16, 16, 0, 1, 73));
    material.alpha_mask = true;
    material.alpha_cutoff = 0.5f;
    scene_add_square(scene, &material, 1, right);
    add_light(scene);
    scene_end(scene);
    return scene;
}

static lobe_render_parameters parameters(const char *filter) {
    return (lobe_render_parameters){
        .filter = filter_named(filter), .width = EXTENT, .height = EXTENT, .reference.samples = 2};
}

static uint64_t picture(fixture *f, lobe_renderer *renderer, const lobe_render_parameters *wanted) {
    lobe_frame frame;
    if (lobe_renderer_render(renderer, wanted, &frame) != LOBE_OK)
        fail_msg("%s", f->error);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

static lobe_renderer *renderer_of(fixture *f, const lobe_scene *scene) {
    lobe_renderer *renderer;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    return renderer;
}

/// A device of its own, where no pipeline is known.
static fixture start(fixture *f) {
    fixture own = *f;
    faults.paused = true; // nothing fails by itself
    faults.making = NULL;
    fixture_forget_messages(f);
    own.device = fixture_device(f, (lobe_device_parameters){0});
    return own;
}

static void stop(fixture *f, fixture *own) {
    assert_int_equal(lobe_device_validation_count(own->device), 0);
    lobe_device_destroy(&own->device);
    assert_int_equal(f->errors, 0);
}

// ---------------------------------------------------------------------------------------------
// In the same thread

/// What a frame may have beside the filter.
typedef struct way {
    const char *filter, *settings[3];
    bool outputs, target, environment;
    bool asks; ///< the device about texels that decide which pipelines there are
} way;

static const way ways[] = {
    {"direct", {NULL}, true, false, false, false},
    {"lobes", {"env_size=16"}, true, true, true, true},
    {"moments", {"samples=4", "bins=2"}, false, false, false, true},
    {"reference", {"env_size=16"}, true, true, true, false},
    {"reference", {NULL}, false, false, false, false},
    {"toksvig", {NULL}, true, false, false, true},
};

static void check_way(fixture *f, const way *by, const lobe_vulkan_image *image) {
    lobe_scene *scene = rich_scene();
    if (by->environment)
        scene_set_environment(scene, random_map(16, 8, 0, 1, 42));
    lobe_renderer *renderer = renderer_of(f, scene);
    lobe_render_parameters wanted = parameters(by->filter);
    const lobe_settings settings = settings_of(wanted.filter, by->settings);
    const lobe_render_target target = {.radiance = image,
                                       .viewport = {image->width - EXTENT, 0, EXTENT, EXTENT}};
    wanted.settings = &settings;
    wanted.aov = wanted.motion.deliver = by->outputs;
    wanted.host.target = by->target ? &target : NULL;
    lobe_device_memory before, after;
    lobe_device_memory_query(f->device, &before);
    const int submissions = vulkan_calls("vkQueueSubmit2");
    faults.pipelines = 0;
    if (lobe_renderer_prepare(renderer, &wanted) != LOBE_OK)
        fail_msg("%s: %s", by->filter, f->error);
    const int made = faults.pipelines;
    lobe_device_memory_query(f->device, &after);
    assert_true(after.used_bytes <= before.used_bytes + (by->asks ? 1024 : 0));
    assert_int_equal(vulkan_calls("vkQueueSubmit2") - submissions, by->asks);
    faults.pipelines = 0;
    for (int n = 0; n < 2; n++)
        picture(f, renderer, &wanted);
    if (made == 0 || faults.pipelines)
        fail_msg("%s: %d pipelines prepared, %d made later", by->filter, made, faults.pipelines);
    lobe_renderer_destroy(&renderer);
    lobe_scene_destroy(&scene);
}

/// Squares with one material; on CPUs, many of them are shaded afterwards.
static lobe_scene *squares(uint32_t count) {
    lobe_scene *scene = scene_begin();
    const lobe_material material = bumpy_material(scene, 1);
    scene_add_square(scene, &material, 2, NULL);
    for (uint32_t i = 1; i < count; i++)
        assert_int_equal(scenes_add_instance(scene, 0, 0, NULL, NULL), LOBE_OK);
    add_light(scene);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// Whichever way their surfaces are shaded (knob shading).
static void prepared_materials_serve_larger_scenes(void **state) {
    static const char *const settings[][3] = {
        {"bins=2"}, {"bins=2", "samples=2"}, {"bins=2", "built=seen"}};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        fixture own = start(*state);
        lobe_scene *few = squares(1), *many = squares(128);
        lobe_renderer *renderer = renderer_of(&own, few);
        lobe_render_parameters wanted = parameters("moments");
        const lobe_settings chosen = settings_of(wanted.filter, settings[i]);
        wanted.settings = &chosen;
        wanted.width = wanted.height = 128;
        assert_int_equal(lobe_renderer_prepare(renderer, &wanted), LOBE_OK);
        faults.pipelines = 0;
        picture(&own, renderer, &wanted);
        assert_int_equal(count_passes(lobe_renderer_graph(renderer), "surfaces", LOBE_PASS_RUN), 0);
        assert_int_equal(lobe_renderer_set_scene(renderer, many), LOBE_OK);
        picture(&own, renderer, &wanted);
        if (lobe_device_describe(own.device)->type == LOBE_DEVICE_CPU)
            assert_true(count_passes(lobe_renderer_graph(renderer), "surfaces", LOBE_PASS_RUN) > 0);
        assert_int_equal(faults.pipelines, 0);
        lobe_renderer_destroy(&renderer);
        lobe_scene_destroy(&few);
        lobe_scene_destroy(&many);
        stop(*state, &own);
    }
}

static void prepared_frames_make_no_pipelines(void **state) {
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        fixture own = start(*state);
        host_device host = {0};
        lobe_vulkan_export_device(own.device, &host.vulkan);
        const VkImageUsageFlags usage =
            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        const uint32_t width = EXTENT + (i == 1 ? 8 : 0); // the picture is a part of it, or all
        host_image image =
            host_image_create(&host, VK_FORMAT_R16G16B16A16_SFLOAT, width, EXTENT, usage);
        const lobe_vulkan_image lent = {.image = image.image,
                                        .format = image.format,
                                        .width = width,
                                        .height = EXTENT,
                                        .usage = usage,
                                        .final_layout = VK_IMAGE_LAYOUT_GENERAL};
        check_way(&own, &ways[i], &lent);
        host_image_destroy(&host, &image);
        stop(*state, &own);
    }
}

static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->images[0] = lobe_graph_import_texture(graph, user);
}

/// Filters adapt to what is given in each frame with passes of their own.
static void given_images_are_prepared_for(void **state) {
    static const char *const filters[] = {"lean", "moments"};
    for (int i = 0; i < 2; i++) {
        fixture own = start(*state);
        lobe_scene *scene = rich_scene();
        lobe_texture *texture;
        const lobe_texture_parameters normals = {.image = &scene->images[0].image};
        assert_int_equal(lobe_texture_create(own.device, &normals, &texture), LOBE_OK);
        scene->images[0].on_device = true;
        lobe_renderer *renderer = renderer_of(&own, scene);
        const lobe_render_parameters wanted = parameters(filters[i]);
        lobe_renderer_set_content_giver(renderer, give, texture);
        assert_int_equal(lobe_renderer_prepare(renderer, &wanted), LOBE_OK);
        faults.pipelines = 0;
        for (int n = 0; n < 2; n++)
            picture(&own, renderer, &wanted);
        assert_int_equal(faults.pipelines, 0);
        lobe_renderer_destroy(&renderer);
        lobe_texture_destroy(&texture);
        lobe_scene_destroy(&scene);
        stop(*state, &own);
    }
}

static void preparing_changes_no_picture(void **state) {
    fixture own = start(*state);
    lobe_scene *scene = rich_scene();
    lobe_renderer *renderer = renderer_of(&own, scene);
    lobe_render_parameters wanted = parameters("toksvig");
    wanted.motion.deliver = true;
    const uint64_t before = picture(&own, renderer, &wanted);
    lobe_render_parameters other = parameters("lean");
    other.motion.deliver = true;
    scene->instances[0].transform[12] += 0.1f;
    assert_int_equal(lobe_renderer_prepare(renderer, &other), LOBE_OK);
    scene->instances[0].transform[12] -= 0.1f;
    assert_true(picture(&own, renderer, &wanted) == before);
    // Maps that were built are still there, and what moved since is what moved since the frame.
    assert_int_equal(count_passes(lobe_renderer_graph(renderer), NULL, LOBE_PASS_RUN), 2);
    lobe_renderer_destroy(&renderer);
    lobe_scene_destroy(&scene);
    stop(*state, &own);
}

typedef struct listener {
    int calls, most;
    double last;
    bool increases;
} listener;

static bool listen(void *user, double part) {
    listener *self = user;
    self->increases = self->increases && part > self->last && part <= 1;
    self->last = part;
    return ++self->calls < self->most;
}

static void progress_is_told_and_may_stop(void **state) {
    fixture own = start(*state);
    lobe_scene *scene = rich_scene();
    lobe_renderer *renderer = renderer_of(&own, scene);
    lobe_render_parameters wanted = parameters("toksvig");
    listener first = {.most = 3, .increases = true}, second = {.most = 1000, .increases = true};
    wanted.host.progress = listen;
    wanted.host.user = &first;
    faults.pipelines = 0;
    assert_int_equal(lobe_renderer_prepare(renderer, &wanted), LOBE_OK);
    assert_int_equal(first.calls, 3);
    // With one that asks about texels.
    assert_true(faults.pipelines <= 4 && first.increases && first.last < 1);
    wanted.host.user = &second;
    assert_int_equal(lobe_renderer_prepare(renderer, &wanted), LOBE_OK);
    assert_true(second.increases && second.last == 1);
    faults.pipelines = 0;
    wanted.host.progress = NULL;
    picture(&own, renderer, &wanted);
    assert_int_equal(faults.pipelines, 0);
    lobe_renderer_destroy(&renderer);
    lobe_scene_destroy(&scene);
    stop(*state, &own);
}

// ---------------------------------------------------------------------------------------------
// In other threads

/// Holds threads that make pipelines until it opens; all but the test's own.
typedef struct gate {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    pthread_t tester;
    bool open;
    int waiting;
    bool takes_signals; ///< one of those that waited
    VkResult refusal;   ///< what the first one gets
} gate;

static gate the_gate;

static VkResult pass_the_gate(void) {
    if (pthread_equal(pthread_self(), the_gate.tester))
        return VK_SUCCESS;
    sigset_t blocked;
    pthread_sigmask(SIG_BLOCK, NULL, &blocked);
    pthread_mutex_lock(&the_gate.mutex);
    ++the_gate.waiting;
    the_gate.takes_signals |= !sigismember(&blocked, SIGTERM);
    pthread_cond_broadcast(&the_gate.changed);
    while (!the_gate.open)
        pthread_cond_wait(&the_gate.changed, &the_gate.mutex);
    const VkResult refusal = the_gate.refusal;
    the_gate.refusal = VK_SUCCESS;
    pthread_mutex_unlock(&the_gate.mutex);
    return refusal;
}

static void close_the_gate(VkResult refusal) {
    pthread_mutex_init(&the_gate.mutex, NULL);
    pthread_cond_init(&the_gate.changed, NULL);
    the_gate.tester = pthread_self();
    the_gate.open = false;
    the_gate.waiting = 0;
    the_gate.takes_signals = false;
    the_gate.refusal = refusal;
    faults.making = pass_the_gate;
}

static void wait_at_the_gate(int count) {
    pthread_mutex_lock(&the_gate.mutex);
    while (the_gate.waiting < count)
        pthread_cond_wait(&the_gate.changed, &the_gate.mutex);
    pthread_mutex_unlock(&the_gate.mutex);
}

static void open_the_gate(void) {
    pthread_mutex_lock(&the_gate.mutex);
    the_gate.open = true;
    pthread_cond_broadcast(&the_gate.changed);
    pthread_mutex_unlock(&the_gate.mutex);
}

static void remove_the_gate(void) {
    faults.making = NULL;
    pthread_mutex_destroy(&the_gate.mutex);
    pthread_cond_destroy(&the_gate.changed);
}

/// A preparation, and what it told. Only the test's own thread asserts.
typedef struct job {
    lobe_preparation *preparation;
    sem_t told;
    int calls;
    lobe_result result;
} job;

static void tell(void *user, lobe_result result) {
    job *self = user;
    ++self->calls;
    self->result = result;
    sem_post(&self->told);
}

static lobe_result try_to_begin(job *self, const fixture *f, const lobe_scene *scene,
                                const lobe_render_parameters *wanted) {
    const lobe_preparation_parameters asked = {
        .scene = scene, .frames = wanted, .frame_count = 1, .done = tell, .user = self};
    self->calls = 0;
    sem_init(&self->told, 0, 0);
    return lobe_preparation_begin(f->device, &asked, &f->host, &self->preparation);
}

static void begin(job *self, const fixture *f, const lobe_scene *scene,
                  const lobe_render_parameters *wanted) {
    assert_int_equal(try_to_begin(self, f, scene, wanted), LOBE_OK);
}

/// Waits until it is done; the preparation stays.
static void end(job *self) {
    lobe_result result = LOBE_RESULT_COUNT;
    sem_wait(&self->told);
    while (!lobe_preparation_is_done(self->preparation, &result))
        nanosleep(&(struct timespec){.tv_nsec = 100000}, NULL);
    assert_int_equal(self->calls, 1);
    assert_int_equal(result, self->result);
}

static void drop(job *self) {
    lobe_preparation_destroy(&self->preparation);
    assert_null(self->preparation);
    sem_destroy(&self->told);
}

/// Two materials, of which only the first has an instance.
static lobe_scene *growing_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = bumpy_material(scene, 80);
    scene_add_square(scene, &material, 1, NULL);
    material.alpha_mask = true;
    material.alpha_cutoff = 0.3f;
    material.emissive[1] = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.4, 82));
    scene_add_square(scene, &material, 1, NULL);
    scene->instances[1].transform[13] = 0.1f;
    add_light(scene);
    scene_end(scene);
    --scene->instance_count;
    return scene;
}

static lobe_scene with_new_material(const lobe_scene *scene) {
    lobe_scene grown = *scene;
    grown.instance_count = 2;
    return grown;
}

/// The device that another renderer draws on is not held up while pipelines are made, and then
/// draws the new material without making one.
static void frames_go_on_while_others_prepare(void **state) {
    static const char *const filters[] = {"direct", "toksvig"};
    for (int i = 0; i < 2; i++) {
        fixture own = start(*state);
        lobe_scene *scene = growing_scene();
        const lobe_scene grown = with_new_material(scene);
        const lobe_render_parameters wanted = parameters(filters[i]);
        lobe_renderer *renderer = renderer_of(&own, scene);
        const uint64_t before = picture(&own, renderer, &wanted);
        job other;
        close_the_gate(VK_SUCCESS);
        begin(&other, &own, &grown, &wanted);
        wait_at_the_gate(1);
        assert_false(lobe_preparation_is_done(other.preparation, NULL));
        for (int n = 0; n < 3; n++)
            assert_true(picture(&own, renderer, &wanted) == before);
        // Not even what needs another pipeline waits.
        faults.pipelines = 0;
        const lobe_render_parameters further = parameters("mipmap");
        picture(&own, renderer, &further);
        assert_true(faults.pipelines > 0);
        open_the_gate();
        end(&other);
        remove_the_gate();
        assert_int_equal(other.result, LOBE_OK);
        scene->instance_count = 2;
        assert_int_equal(lobe_renderer_update_scene(renderer, &(lobe_scene_changes){0}), LOBE_OK);
        faults.pipelines = 0;
        const uint64_t after = picture(&own, renderer, &wanted);
        assert_int_equal(faults.pipelines, 0);
        assert_true(after != before);
        drop(&other);
        lobe_renderer *fresh = renderer_of(&own, scene);
        assert_true(picture(&own, fresh, &wanted) == after);
        lobe_renderer_destroy(&fresh);
        lobe_renderer_destroy(&renderer);
        lobe_scene_destroy(&scene);
        stop(*state, &own);
    }
}

/// How many pipelines a scene needs.
static int pipelines_of(fixture *f, const lobe_scene *scene, const lobe_render_parameters *wanted) {
    fixture own = start(f);
    lobe_renderer *renderer = renderer_of(&own, scene);
    faults.pipelines = 0;
    assert_int_equal(lobe_renderer_prepare(renderer, wanted), LOBE_OK);
    const int count = faults.pipelines;
    lobe_renderer_destroy(&renderer);
    stop(f, &own);
    return count;
}

/// Whoever needs a pipeline that another thread makes gets that one.
static void threads_make_each_pipeline_once(void **state) {
    enum { JOBS = 3 };
    lobe_scene *scene = rich_scene();
    const lobe_render_parameters wanted = parameters("toksvig");
    const int expected = pipelines_of(*state, scene, &wanted);
    fixture own = start(*state);
    job jobs[JOBS];
    close_the_gate(VK_SUCCESS);
    faults.pipelines = 0;
    for (int n = 0; n < JOBS; n++)
        begin(&jobs[n], &own, scene, &wanted);
    wait_at_the_gate(1);
    nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
    open_the_gate();
    for (int n = 0; n < JOBS; n++) {
        end(&jobs[n]);
        assert_int_equal(jobs[n].result, LOBE_OK);
        drop(&jobs[n]);
    }
    remove_the_gate();
    assert_int_equal(faults.pipelines, expected);
    lobe_scene_destroy(&scene);
    stop(*state, &own);
}

/// Who waited for a pipeline that could not be made makes it.
static void a_failure_stays_in_its_thread(void **state) {
    fixture *f = *state;
    lobe_scene *scene = rich_scene();
    const lobe_render_parameters wanted = parameters("toksvig");
    const int expected = pipelines_of(f, scene, &wanted);
    fixture own = start(f);
    job jobs[2];
    close_the_gate(VK_ERROR_OUT_OF_DEVICE_MEMORY);
    faults.pipelines = 0;
    begin(&jobs[0], &own, scene, &wanted);
    wait_at_the_gate(1);
    begin(&jobs[1], &own, scene, &wanted);
    nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
    open_the_gate();
    for (int n = 0; n < 2; n++) {
        end(&jobs[n]);
        drop(&jobs[n]);
    }
    remove_the_gate();
    assert_int_equal(jobs[0].result, LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_int_equal(jobs[1].result, LOBE_OK);
    assert_int_equal(faults.pipelines, expected);
    assert_int_equal(f->errors, 1);
    fixture_forget_messages(f);
    lobe_scene_destroy(&scene);
    stop(f, &own);
}

static void *open_later(void *unused) {
    (void)unused;
    nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
    open_the_gate();
    return NULL;
}

/// No more than the pipeline that is in the making is waited for, and nobody is told.
static void a_preparation_can_be_given_up(void **state) {
    lobe_scene *scene = rich_scene();
    const lobe_render_parameters wanted = parameters("toksvig");
    const int expected = pipelines_of(*state, scene, &wanted);
    fixture own = start(*state);
    job given_up;
    pthread_t opener;
    close_the_gate(VK_SUCCESS);
    faults.pipelines = 0;
    begin(&given_up, &own, scene, &wanted);
    wait_at_the_gate(1);
    assert_int_equal(pthread_create(&opener, NULL, open_later, NULL), 0);
    drop(&given_up);
    assert_int_equal(pthread_join(opener, NULL), 0);
    remove_the_gate();
    assert_int_equal(given_up.calls, 0);
    assert_int_equal(faults.pipelines, 1);
    assert_true(expected > 1);
    assert_false(the_gate.takes_signals);
    lobe_scene_destroy(&scene);
    stop(*state, &own);
}

/// Each allocation that fails in either thread is told of once, and nothing is left.
static void allocations_may_fail(void **state) {
    fixture *f = *state;
    counting_allocator counting;
    counting_allocator_start(&counting);
    fixture own = start(f);
    lobe_device_destroy(&own.device);
    own.host.allocator = &counting.allocator;
    own.device = fixture_device(&own, (lobe_device_parameters){0});
    lobe_scene *scene = rich_scene();
    const lobe_render_parameters wanted = parameters("direct");
    size_t failing = 1, failures = 0;
    for (bool failed = true; failed; ++failing) {
        job trial;
        const size_t blocks = counting.blocks;
        counting.taken = 0;
        counting.failing = failing;
        lobe_result result = try_to_begin(&trial, &own, scene, &wanted);
        if (result == LOBE_OK) {
            end(&trial);
            result = trial.result;
        }
        drop(&trial);
        counting.failing = 0;
        failed = result != LOBE_OK;
        failures += failed;
        assert_int_equal(f->errors, failed);
        assert_true(!failed || result == LOBE_ERROR_OUT_OF_MEMORY);
        // What a failed one has made of pipelines and shaders stays on the device.
        assert_true(counting.blocks >= blocks);
        fixture_forget_messages(f);
    }
    assert_true(failures > 20);
    lobe_scene_destroy(&scene);
    stop(f, &own);
    assert_nothing_left(&counting);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void mistakes_are_those_of_frames(void **state) {
    fixture *f = *state;
    fixture own = start(f);
    lobe_scene *scene = rich_scene();
    lobe_renderer *renderer = renderer_of(&own, scene);
    lobe_render_parameters wanted = parameters("direct");
    wanted.height = 0;
    assert_failure(f, lobe_renderer_prepare(renderer, &wanted), LOBE_ERROR_INVALID_ARGUMENT,
                   "a picture of 8x0 pixels");
    fixture_forget_messages(f);
    wanted = parameters("direct");
    wanted.host.target = &(lobe_render_target){0};
    assert_failure(f, lobe_renderer_prepare(renderer, &wanted), LOBE_ERROR_INVALID_ARGUMENT,
                   "a target without radiance");
    fixture_forget_messages(f);
    job other;
    wanted = parameters("direct");
    begin(&other, &own, &(lobe_scene){.name = "nothing"}, &wanted);
    end(&other);
    drop(&other);
    assert_int_equal(other.result, LOBE_ERROR_MALFORMED);
    fixture_forget_messages(f);
    wanted.width = 0;
    begin(&other, &own, scene, &wanted);
    end(&other);
    drop(&other);
    assert_int_equal(other.result, LOBE_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(f->error, "a picture of 0x8 pixels"));
    fixture_forget_messages(f);
    lobe_renderer_destroy(&renderer);
    lobe_scene_destroy(&scene);
    stop(f, &own);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prepared_frames_make_no_pipelines),
        cmocka_unit_test(prepared_materials_serve_larger_scenes),
        cmocka_unit_test(given_images_are_prepared_for),
        cmocka_unit_test(preparing_changes_no_picture),
        cmocka_unit_test(progress_is_told_and_may_stop),
        cmocka_unit_test(frames_go_on_while_others_prepare),
        cmocka_unit_test(threads_make_each_pipeline_once),
        cmocka_unit_test(a_failure_stays_in_its_thread),
        cmocka_unit_test(a_preparation_can_be_given_up),
        cmocka_unit_test(allocations_may_fail),
        cmocka_unit_test(mistakes_are_those_of_frames),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
