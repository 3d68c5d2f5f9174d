// Scenes that change with time: their maps depend on the time alone, change from frame to frame,
// and are drawn by every filter.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include "tests/passes/support/picture.h"
#include "tools/animation/animation.h"
#include "tools/scenes/scene_list.h"

typedef struct playing {
    fixture *f;
    lobe_scene *scene;
    animation *animation;
} playing;

static playing play(fixture *f, const char *name) {
    playing p = {.f = f};
    assert_int_equal(scene_list_open(name, NULL, false, &f->host, &p.scene), LOBE_OK);
    assert_int_equal(animation_create(f->device, p.scene, &f->host, &p.animation), LOBE_OK);
    animation_attach(p.animation, f->renderer);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, p.scene), LOBE_OK);
    return p;
}

static void stop(playing *p) {
    assert_int_equal(lobe_renderer_set_scene(p->f->renderer, NULL), LOBE_OK);
    animation_attach(NULL, p->f->renderer);
    animation_destroy(&p->animation);
    lobe_scene_destroy(&p->scene);
    assert_int_equal(p->f->errors, 0);
    assert_int_equal(lobe_device_validation_count(p->f->device), 0);
}

static lobe_frame picture(playing *p, const char *filter, double seconds) {
    const picture_request request = {.filter = filter, .width = 48, .height = 27, .samples = 2};
    animation_set_time(p->animation, seconds);
    return draw(p->f, &request);
}

static uint64_t hash_at(playing *p, double seconds) {
    lobe_frame frame = picture(p, "mipmap", seconds);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

/// Of the image that is on the device.
static const lobe_image *example_of(const lobe_scene *scene) {
    size_t i = 0;
    while (!scene->images[i].on_device)
        ++i;
    return &scene->images[i].image;
}

static void frames_depend_on_the_time_alone(void **state) {
    playing p = play(*state, "cloth");
    const uint64_t first = hash_at(&p, 0), later = hash_at(&p, 1.5);
    assert_true(first != later);
    assert_true(hash_at(&p, 0) == first);
    assert_true(hash_at(&p, 1.5) == later);
    assert_float_equal(animation_time(p.animation), 1.5, 0);
    stop(&p);
}

static void an_animation_begins_with_its_example(void **state) {
    fixture *f = *state;
    playing p = play(f, "cloth");
    const lobe_image *example = example_of(p.scene);
    lobe_image still = *example;
    const size_t size = (size_t)still.width * still.height * 4;
    still.texels = lobe_allocate(NULL, size, 1);
    memcpy(still.texels, example->texels, size);
    const uint64_t moving = hash_at(&p, 0);
    stop(&p);
    // The same texels, uploaded.
    lobe_scene *scene;
    assert_int_equal(scene_list_open("tablecloth", NULL, false, &f->host, &scene), LOBE_OK);
    assert_true(memcmp(scene->images[0].image.texels, still.texels, size) != 0);
    lobe_release(scene->images[0].image.texels);
    scene->images[0].image = still;
    p = (playing){.f = f, .scene = scene};
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_true(hash_at(&p, 0) == moving);
    stop(&p);
}

/// Each time is as good as the first, for which the bins were fitted.
static void filters_follow_the_texels(void **state) {
    static const char *const filters[] = {"lobes", "moments"};
    playing p = play(*state, "cloth");
    for (int n = 0; n < 2; n++) {
        lobe_frame truth = picture(&p, "reference", 20 * n);
        lobe_frame direct = picture(&p, "direct", 20 * n);
        const double most = relative_l2(&direct.radiance, &truth.radiance);
        for (int i = 0; i < 2; i++) {
            lobe_frame frame = picture(&p, filters[i], 20 * n);
            const double error = relative_l2(&frame.radiance, &truth.radiance);
            print_message("# %s at %d s: error %.3f, direct %.3f\n", filters[i], 20 * n, error,
                          most);
            assert_true(error < most);
            lobe_frame_free(&frame);
        }
        lobe_frame_free(&direct);
        lobe_frame_free(&truth);
    }
    stop(&p);
}

static void rain_falls(void **state) {
    playing p = play(*state, "rain");
    assert_true(hash_at(&p, 0) != hash_at(&p, 0.2));
    stop(&p);
}

static void other_scenes_stand_still(void **state) {
    playing p = play(*state, "checkerboard");
    assert_null(p.animation);
    assert_true(hash_at(&p, 0) == hash_at(&p, 5));
    assert_float_equal(animation_time(p.animation), 0, 0);
    stop(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_depend_on_the_time_alone),
        cmocka_unit_test(an_animation_begins_with_its_example),
        cmocka_unit_test(filters_follow_the_texels),
        cmocka_unit_test(rain_falls),
        cmocka_unit_test(other_scenes_stand_still),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
