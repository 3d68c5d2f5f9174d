// Materials that a pose moves: every renderer of the scene follows without being told, pictures
// equal those of a scene that was always like that, and only maps that depend on it are rebuilt.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16 };

static void *copy_of(const void *values, size_t size) {
    void *copy = lobe_allocate(NULL, 1, size);
    memcpy(copy, values, size);
    return copy;
}

static lobe_animation_channel channel_of(lobe_channel_path path, lobe_posed_map map, size_t width,
                                         const float *values) {
    return (lobe_animation_channel){
        .path = path,
        .map = map,
        .interpolation = LOBE_INTERPOLATION_LINEAR,
        .times = copy_of((float[]){0, 1}, 2 * sizeof(float)),
        .key_count = 2,
        .width = width,
        .values = copy_of(values, 2 * width * sizeof *values),
    };
}

/// A rig whose animations each move one thing of the first material.
static lobe_rig *rig_of(const lobe_animation_channel *channels, size_t count) {
    lobe_rig *rig = lobe_allocate(NULL, 1, sizeof *rig);
    rig->camera_node = -1;
    rig->materials = lobe_allocate(NULL, 1, sizeof *rig->materials);
    rig->material_count = 1;
    lobe_material_numbers *rest = &rig->materials[0].rest;
    *rest = (lobe_material_numbers){
        .metallic = 0.5f, .roughness = 0.4f, .normal_scale = 1, .emissive_strength = 0.25f};
    for (int map = 0; map < LOBE_POSED_MAP_COUNT; map++)
        rest->maps[map].scale[0] = rest->maps[map].scale[1] = 1;
    for (int i = 0; i < 4; i++)
        rest->base_colour[i] = 1;
    rig->animations = lobe_allocate(NULL, count, sizeof *rig->animations);
    rig->animation_count = count;
    for (size_t i = 0; i < count; i++) {
        rig->animations[i].name = lobe_copy_text(NULL, "");
        rig->animations[i].duration = 1;
        rig->animations[i].channels = copy_of(&channels[i], sizeof channels[i]);
        rig->animations[i].channel_count = 1;
    }
    return rig;
}

enum { COLOUR, ROUGHNESS, METAL, EMISSION, OFFSET, APART };

static lobe_scene *posed_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = 0.4f;
    material.metallic = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, 8));
    material.emissive_map = scene_add_map(scene, random_map(16, 16, 0, 1, 9));
    material.base_colour_map = scene_add_map(scene, random_map(16, 16, 0, 1, 10));
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_down(scene, 2.2);
    scene_end(scene);
    const lobe_animation_channel channels[] = {
        [COLOUR] = channel_of(LOBE_CHANNEL_BASE_COLOUR, 0, 4, (float[]){0, 1, 0, 1, 1, 0, 0, 1}),
        [ROUGHNESS] = channel_of(LOBE_CHANNEL_ROUGHNESS, 0, 1, (float[]){0.3f, 0.8f}),
        [METAL] = channel_of(LOBE_CHANNEL_METALLIC, 0, 1, (float[]){0, 1}),
        [EMISSION] = channel_of(LOBE_CHANNEL_EMISSIVE_STRENGTH, 0, 1, (float[]){0, 1}),
        [OFFSET] = channel_of(LOBE_CHANNEL_MAP_OFFSET, LOBE_POSED_EMISSIVE_MAP, 2,
                              (float[]){0, 0, 1, 0.5f}),
        [APART] = channel_of(LOBE_CHANNEL_MAP_OFFSET, LOBE_POSED_NORMAL_MAP, 2,
                             (float[]){0.1f, 0, 0.9f, 0.5f}),
    };
    scene->rig = rig_of(channels, sizeof channels / sizeof *channels);
    for (int i = 0; i < 3; i++)
        scene->rig->materials[0].rest.emissive[i] = 1;
    return scene;
}

static lobe_frame draw_now(fixture *f, const char *filter) {
    const picture_request request = {.filter = filter, .width = EXTENT, .height = EXTENT};
    return draw_silently(f, "posed", &request);
}

static void pose(lobe_scene *scene, size_t animation, double seconds) {
    const lobe_pose at = {.animation = animation, .seconds = seconds};
    assert_int_equal(lobe_scene_set_pose(scene, &at, NULL), LOBE_OK);
}

static size_t count_run(fixture *f) {
    return count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN);
}

/// Asserts that a renderer draws what a new one draws.
static void check_picture(fixture *f, const char *filter, const lobe_scene *scene,
                          const lobe_image *picture) {
    fixture fresh = *f;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &fresh.renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(fresh.renderer, scene), LOBE_OK);
    lobe_frame expected = draw_now(&fresh, filter);
    assert_true(relative_l2(picture, &expected.radiance) < 1e-5);
    lobe_frame_free(&expected);
    lobe_renderer_destroy(&fresh.renderer);
}

/// `passes`: that run in the frame; 0: some that make maps, too.
static void check_animation(fixture *f, const char *filter, size_t animation, size_t passes) {
    lobe_scene *scene = posed_scene();
    pose(scene, animation, 0);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame frame = draw_now(f, filter);
    uint64_t before = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    for (double seconds = 0.25; seconds < 1; seconds += 0.25) {
        pose(scene, animation, seconds);
        frame = draw_now(f, filter);
        if (passes > 0)
            assert_int_equal(count_run(f), passes);
        else
            assert_true(count_run(f) > 1);
        if (image_hash(&frame.radiance) == before)
            fail_msg("%s: animation %zu changes nothing", filter, animation);
        before = image_hash(&frame.radiance);
        check_picture(f, filter, scene, &frame.radiance);
        lobe_frame_free(&frame);
    }
    frame = draw_now(f, filter); // nothing has changed since
    assert_int_equal(count_run(f), 1);
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void pictures_follow_poses(void **state) {
    static const char *const filters[] = {"direct", "toksvig", "lobes"};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        const bool maps = i > 0; // of roughness
        check_animation(*state, filters[i], COLOUR, 1);
        check_animation(*state, filters[i], ROUGHNESS, maps ? 0 : 1);
        check_animation(*state, filters[i], METAL, 1);
        check_animation(*state, filters[i], EMISSION, 1);
        check_animation(*state, filters[i], OFFSET, 1);
        check_animation(*state, filters[i], APART, 1);
    }
}

/// Bins may have colours of their own only where maps lie alike, which the first moves of a normal
/// map end; then nothing is built any more.
static void bins_follow_poses(void **state) {
    check_animation(*state, "moments", EMISSION, 1);
    check_animation(*state, "moments", OFFSET, 1);
    check_animation(*state, "moments", APART, 1);
}

static void all_renderers_follow(void **state) {
    fixture *f = *state;
    fixture other = *f;
    lobe_scene *scene = posed_scene();
    pose(scene, ROUGHNESS, 0);
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &other.renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(other.renderer, scene), LOBE_OK);
    for (double seconds = 0; seconds < 1; seconds += 0.25) {
        pose(scene, ROUGHNESS, seconds);
        lobe_frame first = draw_now(f, "lean"), second = draw_now(&other, "lean");
        check_picture(f, "lean", scene, &first.radiance);
        assert_true(image_hash(&first.radiance) == image_hash(&second.radiance));
        lobe_frame_free(&first);
        lobe_frame_free(&second);
    }
    lobe_renderer_destroy(&other.renderer);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// A rig of the host's that names a material that is not there moves none.
static void rigs_of_nothing_are_refused(void **state) {
    fixture *f = *state;
    lobe_scene *scene = posed_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    scene->rig->materials[0].material = 7;
    scene->rig->materials[0].version++;
    lobe_frame frame = draw_now(f, "lean");
    lobe_frame_free(&frame);
    assert_int_equal(lobe_scene_set_pose(scene, NULL, NULL), LOBE_ERROR_MALFORMED);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_follow_poses),
        cmocka_unit_test(bins_follow_poses),
        cmocka_unit_test(all_renderers_follow),
        cmocka_unit_test(rigs_of_nothing_are_refused),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
