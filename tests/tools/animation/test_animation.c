// Scenes that change with time: their maps depend on the time alone, change from frame to frame,
// and are drawn by every filter.

#include "tests/passes/support/fixture.h"

#include <math.h>
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
    assert_int_equal(animation_set_time(p->animation, seconds), LOBE_OK);
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

/// The mean square of the differences between a pixel and its neighbour above, in rows.
static double roughness(const lobe_image *image, uint32_t first, uint32_t count) {
    double sum = 0;
    for (uint32_t y = first; y < first + count; y++)
        for (uint32_t x = 0; x < image->width; x++)
            sum += pow(pixel_at(image, x, y)[1] - pixel_at(image, x, y - 1)[1], 2);
    return sum / (count * image->width);
}

// It moves, every frame depends on its time alone, and the far sea is smooth where one sample
// aliases.
static void the_sea_moves(void **state) {
    playing p = play(*state, "ocean");
    lobe_frame first = picture(&p, "leadr", 0), later = picture(&p, "leadr", 1);
    lobe_frame again = picture(&p, "leadr", 0), direct = picture(&p, "direct", 0);
    assert_true(image_hash(&first.radiance) == image_hash(&again.radiance));
    assert_true(relative_l2(&later.radiance, &first.radiance) > 0.1);
    // The horizon is at a fifth of the picture.
    assert_true(roughness(&first.radiance, 7, 4) < 0.3 * roughness(&direct.radiance, 7, 4));
    lobe_frame_free(&first);
    lobe_frame_free(&later);
    lobe_frame_free(&again);
    lobe_frame_free(&direct);
    stop(&p);
}

/// Of a smaller map than the scene's: the heights are nowhere on the host.
static void a_terrain_is_made_on_the_device(void **state) {
    fixture *f = *state;
    playing p = {.f = f};
    assert_int_equal(scene_list_open("terrain", NULL, false, &f->host, &p.scene), LOBE_OK);
    for (size_t i = 0; i < p.scene->image_count; i++) {
        assert_true(p.scene->images[i].on_device);
        assert_null(p.scene->images[i].image.texels);
        assert_int_equal(p.scene->images[i].image.width, 8192);
        p.scene->images[i].image.width = p.scene->images[i].image.height = 256;
    }
    assert_int_equal(animation_create(f->device, p.scene, &f->host, &p.animation), LOBE_OK);
    assert_float_equal(animation_duration(p.animation), 20, 1e-6);
    animation_attach(p.animation, f->renderer);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, p.scene), LOBE_OK);
    picture_request request = {.filter = "leadr", .width = 96, .height = 54};
    assert_int_equal(animation_set_time(p.animation, 4), LOBE_OK);
    lobe_frame flat = draw(f, &request);
    request.settings[0] = "displacement=geometry";
    lobe_frame first = draw(f, &request);
    assert_true(all_finite(&first.radiance));
    assert_true(relative_l2(&first.radiance, &flat.radiance) > 0.1);
    // It flies, and its maps are made once.
    assert_int_equal(animation_set_time(p.animation, 10), LOBE_OK);
    lobe_frame far = draw(f, &request);
    assert_true(relative_l2(&far.radiance, &first.radiance) > 0.1);
    lobe_graph *graph = lobe_renderer_graph(f->renderer);
    assert_int_equal(count_passes(graph, "terrain_heights", LOBE_PASS_SKIPPED), 1);
    assert_int_equal(count_passes(graph, "terrain_normals", LOBE_PASS_SKIPPED), 1);
    assert_int_equal(animation_set_time(p.animation, 4), LOBE_OK);
    lobe_frame again = draw(f, &request);
    assert_true(image_hash(&again.radiance) == image_hash(&first.radiance));
    lobe_frame_free(&flat);
    lobe_frame_free(&first);
    lobe_frame_free(&far);
    lobe_frame_free(&again);
    stop(&p);
}

static void other_scenes_stand_still(void **state) {
    playing p = play(*state, "checkerboard");
    assert_null(p.animation);
    assert_true(hash_at(&p, 0) == hash_at(&p, 5));
    assert_float_equal(animation_time(p.animation), 0, 0);
    stop(&p);
}

// ---------------------------------------------------------------------------------------------
// Rigs

static void *allocate(size_t count, size_t size) {
    void *memory = lobe_allocate(NULL, count, size);
    assert_non_null(memory);
    return memory;
}

/// Along x, from 0 to `distance` within `duration`.
static lobe_animation slide(const char *name, float distance, float duration) {
    lobe_animation animation = {.name = lobe_copy_text(NULL, name),
                                .channels = allocate(1, sizeof(lobe_animation_channel)),
                                .channel_count = 1,
                                .duration = duration};
    lobe_animation_channel *channel = animation.channels;
    *channel = (lobe_animation_channel){.interpolation = LOBE_INTERPOLATION_LINEAR,
                                        .times = allocate(2, sizeof(float)),
                                        .key_count = 2,
                                        .width = 3,
                                        .values = allocate(6, sizeof(float))};
    channel->times[1] = duration;
    channel->values[3] = distance;
    return animation;
}

/// A scene with a rig that the host made.
static lobe_scene *rigged_scene(fixture *f) {
    lobe_scene *scene;
    assert_int_equal(scene_list_open("checkerboard", NULL, false, &f->host, &scene), LOBE_OK);
    lobe_rig *rig = scene->rig = allocate(1, sizeof *rig);
    rig->camera_node = -1;
    rig->nodes = allocate(1, sizeof *rig->nodes);
    rig->node_count = 1;
    rig->nodes[0] = (lobe_node){.parent = -1, .rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    rig->instances = allocate(1, sizeof *rig->instances);
    rig->instance_count = 1;
    rig->instances[0] = (lobe_posed_instance){.skinned_mesh = -1};
    rig->animations = allocate(3, sizeof *rig->animations);
    rig->animation_count = 3;
    rig->animations[0] = slide("walk", 1, 2);
    rig->animations[1] = slide("run", 4, 1);
    rig->animations[2] = slide("1", -3, 3);
    return scene;
}

static void rigs_are_posed(void **state) {
    static const struct {
        const char *text;
        size_t index;
        double duration;
        float place; ///< at half a second
    } choices[] = {{"walk", 0, 2, 0.25f},
                   {"run", 1, 1, 2},
                   {"1", 2, 3, -0.5f}, // a name
                   {"0", 0, 2, 0.25f},
                   {"all", LOBE_ANIMATION_ALL, 3, -0.5f}};
    fixture *f = *state;
    playing p = {.f = f, .scene = rigged_scene(f)};
    const float *x = &p.scene->instances[0].transform[12];
    assert_int_equal(animation_create(f->device, p.scene, &f->host, &p.animation), LOBE_OK);
    animation_attach(p.animation, f->renderer);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, p.scene), LOBE_OK);
    const uint64_t first = hash_at(&p, 0);
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++) {
        size_t index = 9;
        assert_int_equal(animation_find(p.scene, choices[i].text, &f->host, &index), LOBE_OK);
        assert_true(index == choices[i].index);
        assert_int_equal(animation_set_index(p.animation, index), LOBE_OK);
        assert_true(animation_index(p.animation) == index);
        assert_float_equal(animation_duration(p.animation), choices[i].duration, 0);
        assert_int_equal(animation_set_time(p.animation, 0.5), LOBE_OK);
        assert_float_equal(*x, choices[i].place, 1e-6);
        assert_true(hash_at(&p, 0.5) != first);
        assert_true(hash_at(&p, 0) == first);
    }
    // What fails changes nothing.
    const float before = *x;
    size_t index;
    assert_failure(f, animation_find(p.scene, "3", &f->host, &index), LOBE_ERROR_NOT_FOUND,
                   "'walk', 'run', '1'");
    fixture_forget_messages(f);
    assert_failure(f, animation_set_index(p.animation, 3), LOBE_ERROR_INVALID_ARGUMENT,
                   "no animation 3");
    fixture_forget_messages(f);
    assert_true(animation_index(p.animation) == LOBE_ANIMATION_ALL && *x == before);
    stop(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_depend_on_the_time_alone),
        cmocka_unit_test(an_animation_begins_with_its_example),
        cmocka_unit_test(filters_follow_the_texels),
        cmocka_unit_test(rain_falls),
        cmocka_unit_test(the_sea_moves),
        cmocka_unit_test(a_terrain_is_made_on_the_device),
        cmocka_unit_test(other_scenes_stand_still),
        cmocka_unit_test(rigs_are_posed),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
