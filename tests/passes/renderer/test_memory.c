// All host memory that lobe takes comes from the host's allocator and is returned to it: that of
// devices, scenes, environments, renderers, frames and files. When an allocation fails, our call
// that needed it returns that error and logs one line, and the same renderer still works.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include <lobe/environment_maps.h>
#include <lobe/exr.h>

#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/host_device.h"
#include "tests/engine/support/temporary_folder.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 8 };

// ---------------------------------------------------------------------------------------------
// All of it

/// Everything that a host creates with lobe, in the host's memory.
typedef struct subject {
    counting_allocator counting;
    log_recorder recorder;
    lobe_device *device;
    lobe_scene *scene;
    lobe_renderer *renderer;
} subject;

static void open_device(subject *s, const host_device *host) {
    *s = (subject){0};
    counting_allocator_start(&s->counting);
    log_recorder_start(&s->recorder);
    s->recorder.host.allocator = &s->counting.allocator;
    const lobe_device_parameters parameters = {.host = &s->recorder.host};
    assert_int_equal(lobe_vulkan_import_device(&host->vulkan, &parameters, &s->device), LOBE_OK);
    assert_ptr_equal(lobe_device_allocator(s->device), &s->counting.allocator);
}

static void open_subject(subject *s, const host_device *host) {
    open_device(s, host);
    assert_int_equal(lobe_scene_open("bumps", &s->recorder.host, &s->scene), LOBE_OK);
    assert_int_equal(lobe_environment_open("sky", &s->recorder.host, &s->scene->environment),
                     LOBE_OK);
    lobe_environment_shrink(s->scene->environment, 16);
    // Silent, but with memory from the device's allocator.
    assert_int_equal(lobe_renderer_create(s->device, NULL, &s->renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(s->renderer, s->scene), LOBE_OK);
}

static void write_frame(subject *s, const lobe_frame *frame) {
    const char *path = temporary_folder_file(&test_folder, "frame.exr");
    const lobe_exr_layer layers[] = {{.image = &frame->radiance},
                                     {.name = "normal", .image = &frame->normal_depth}};
    const lobe_exr_parameters exr = {.layers = layers, .layer_count = 2};
    lobe_image read;
    assert_int_equal(lobe_exr_write(path, &exr, &s->recorder.host), LOBE_OK);
    assert_int_equal(lobe_exr_read(path, NULL, &s->recorder.host, &read), LOBE_OK);
    lobe_image_free(&read);
}

static lobe_result draw_picture(lobe_renderer *renderer, const char *name, lobe_frame *frame) {
    const lobe_filter *filter = filter_named(name);
    lobe_settings settings;
    lobe_settings_default(filter, &settings);
    assert_int_equal(lobe_settings_set(filter, &settings, "env_size=16", NULL), LOBE_OK);
    if (strcmp(name, "moments") == 0)
        assert_int_equal(lobe_settings_set(filter, &settings, "bins=1", NULL), LOBE_OK);
    const lobe_render_parameters parameters = {.filter = filter,
                                               .settings = &settings,
                                               .width = EXTENT,
                                               .height = EXTENT,
                                               .reference.samples = 2,
                                               .aov = true};
    return lobe_renderer_render(renderer, &parameters, frame);
}

static void draw_and_write(subject *s, const char *filter) {
    lobe_frame frame;
    assert_int_equal(draw_picture(s->renderer, filter, &frame), LOBE_OK);
    write_frame(s, &frame);
    lobe_frame_free(&frame);
}

static void prepare_environment(subject *s) {
    lobe_environment_maps *maps;
    lobe_image face;
    const lobe_environment_maps_parameters parameters = {.environment = s->scene->environment,
                                                         .size = 16};
    assert_int_equal(lobe_environment_maps_create(s->device, &parameters, &maps), LOBE_OK);
    assert_int_equal(lobe_environment_maps_read(maps, LOBE_ENVIRONMENT_RADIANCE, 0, 0, &face),
                     LOBE_OK);
    lobe_image_free(&face);
    lobe_environment_maps_destroy(&maps);
}

static void dump(const subject *s) {
    char *text = lobe_graph_dump_text(lobe_renderer_graph(s->renderer));
    char *picture = lobe_graph_dump_graphviz(lobe_renderer_graph(s->renderer));
    assert_non_null(text);
    assert_non_null(picture);
    lobe_release(text);
    lobe_release(picture);
}

static void close_subject(subject *s) {
    lobe_renderer_destroy(&s->renderer);
    lobe_scene_destroy(&s->scene);
    lobe_device_destroy(&s->device);
    assert_int_equal(s->recorder.errors, 0);
    assert_nothing_left(&s->counting);
}

/// Two devices of one host, each with its own allocator.
static void everything_comes_from_the_host_and_goes_back(void **state) {
    (void)state;
    static const char *const filters[] = {"direct", "lobes"};
    host_device host;
    subject subjects[2];
    host_device_open_unvalidated(&host);
    for (int n = 0; n < 2; n++)
        open_subject(&subjects[n], &host);
    const size_t others = subjects[1].counting.taken;
    for (size_t n = 0; n < sizeof filters / sizeof *filters; n++)
        draw_and_write(&subjects[0], filters[n]);
    prepare_environment(&subjects[0]);
    dump(&subjects[0]);
    assert_int_equal(subjects[1].counting.taken, others);
    draw_and_write(&subjects[1], "mipmap");
    // Most of it is the scene's.
    assert_true(subjects[1].counting.bytes > 1 << 20);
    close_subject(&subjects[0]);
    draw_and_write(&subjects[1], "mipmap");
    close_subject(&subjects[1]);
    host_device_close(&host);
}

// ---------------------------------------------------------------------------------------------
// None

typedef struct work {
    lobe_scene *scene;
    lobe_image other; ///< in place of the scene's map
    const char *filter;
    uint64_t expected; ///< hash of the last picture; 0: not known yet
} work;

static lobe_scene *small_scene(bool surrounded) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 0.4, 90));
    scene_add_square(scene, &material, 1, NULL);
    scene_look_down(scene, 2);
    if (surrounded)
        scene_set_environment(scene, random_map(8, 4, 0, 1, 91));
    scene_end(scene);
    return scene;
}

static lobe_result draw_hash(const work *w, lobe_renderer *renderer, uint64_t *hash) {
    lobe_frame frame;
    const lobe_result result = draw_picture(renderer, w->filter, &frame);
    *hash = result == LOBE_OK ? image_hash(&frame.radiance) : 0;
    lobe_frame_free(&frame);
    return result;
}

/// A renderer, a scene, a picture; another map, and a picture of that.
static lobe_result change_and_draw(const work *w, lobe_renderer *renderer, uint64_t *hash) {
    static const uint32_t first = 0;
    lobe_result result = lobe_renderer_set_scene(renderer, w->scene);
    result = result ? result : draw_hash(w, renderer, hash);
    if (result != LOBE_OK)
        return result;
    const lobe_image was = w->scene->images[0].image;
    const lobe_scene_changes changes = {.images = &first, .image_count = 1};
    w->scene->images[0].image = w->other;
    result = lobe_renderer_update_scene(renderer, &changes);
    result = result ? result : draw_hash(w, renderer, hash);
    w->scene->images[0].image = was;
    return result;
}

/// What the device keeps, above all pipelines, exists already: the engine's tests cover that.
/// `with`: the device and log to use; `failing`: which allocation fails, 0: none.
static void check_allocation(work *w, subject *with, size_t failing) {
    uint64_t hash = 0;
    with->recorder.errors = 0;
    with->counting.taken = 0;
    with->counting.failing = failing;
    lobe_result result = lobe_renderer_create(with->device, &with->recorder.host, &with->renderer);
    result = result ? result : change_and_draw(w, with->renderer, &hash);
    if (result != (failing ? LOBE_ERROR_OUT_OF_MEMORY : LOBE_OK) ||
        with->recorder.errors != (failing > 0))
        fail_msg("allocation %zu: %s, %d lines, the last '%s'", failing, lobe_result_name(result),
                 with->recorder.errors, with->recorder.last_error);
    if (failing && with->renderer)
        result = change_and_draw(w, with->renderer, &hash);
    if (with->renderer && (result != LOBE_OK || (w->expected && hash != w->expected)))
        fail_msg("allocation %zu: the picture after it is another", failing);
    w->expected = with->renderer ? hash : w->expected;
    lobe_renderer_destroy(&with->renderer);
}

/// `surrounded`: with an environment, whose maps take time, so only every ninth allocation fails.
static void check_each_allocation(const char *filter, bool surrounded) {
    host_device host;
    subject s;
    work w = {.scene = small_scene(surrounded),
              .other = random_map(4, 2, 0.4, 0.6, 92),
              .filter = filter};
    host_device_open_unvalidated(&host);
    open_device(&s, &host);
    check_allocation(&w, &s, 0);
    const size_t blocks = s.counting.blocks, bytes = s.counting.bytes;
    check_allocation(&w, &s, 0);
    const size_t count = s.counting.taken;
    assert_true(count > 100);
    for (size_t failing = 1; failing <= count; failing += surrounded ? 9 : 1) {
        check_allocation(&w, &s, failing);
        assert_int_equal(s.counting.blocks, blocks);
        assert_int_equal(s.counting.bytes, bytes);
    }
    s.recorder.errors = 0;
    close_subject(&s);
    host_device_close(&host);
    lobe_image_free(&w.other);
    lobe_scene_destroy(&w.scene);
}

static void each_allocation_fails_once(void **state) {
    (void)state;
    check_each_allocation("lobes", false);
}

static void each_allocation_fails_once_for_moments(void **state) {
    (void)state;
    check_each_allocation("moments", false);
}

static void each_allocation_fails_once_for_the_reference(void **state) {
    (void)state;
    check_each_allocation("reference", false);
}

static void many_allocations_fail_once_for_an_environment(void **state) {
    (void)state;
    check_each_allocation("mipmap", true);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(everything_comes_from_the_host_and_goes_back),
        cmocka_unit_test(each_allocation_fails_once),
        cmocka_unit_test(each_allocation_fails_once_for_moments),
        cmocka_unit_test(each_allocation_fails_once_for_the_reference),
        cmocka_unit_test(many_allocations_fail_once_for_an_environment),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
