// Renderers of one scene on one device share its images, meshes and maps: a second one takes next
// to nothing, and neither sees what becomes of the other.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16, ROUNDS = 2 };

static lobe_scene *textured_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.normal_map = scene_add_map(scene, random_normal_map(256, 256, 0.4, 40));
    material.base_colour_map = scene_add_map(scene, random_map(256, 256, 0.2, 1, 41));
    scene_add_sphere(scene, &material, 1);
    scene_set_environment(scene, random_map(64, 32, 0, 1, 42));
    scene_add_sun(scene, (double[]){0.2, 1, 0.1}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

static uint64_t draw_hash(fixture *f, lobe_renderer *renderer) {
    static const picture_request request = {
        .filter = "lobes", .settings = {"env_size=16", NULL}, .width = EXTENT, .height = EXTENT};
    fixture with = *f;
    with.renderer = renderer;
    lobe_frame frame = draw(&with, &request);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

static lobe_renderer *create_renderer(fixture *f, lobe_device *device, const lobe_scene *scene) {
    lobe_renderer *renderer;
    assert_int_equal(lobe_renderer_create(device, &f->host, &renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    return renderer;
}

static uint64_t used_bytes(const fixture *f) {
    lobe_device_memory memory;
    lobe_device_memory_query(f->device, &memory);
    return memory.used_bytes;
}

static void change_normals(lobe_scene *scene) {
    lobe_image_free(&scene->images[0].image);
    scene->images[0].image = random_normal_map(256, 256, 0.6, 43);
}

/// The picture of a scene on a device where nobody else has it.
static uint64_t draw_alone(fixture *f, const lobe_scene *scene) {
    lobe_device *device = fixture_device(f, (lobe_device_parameters){0});
    lobe_renderer *renderer = create_renderer(f, device, scene);
    const uint64_t hash = draw_hash(f, renderer);
    lobe_renderer_destroy(&renderer);
    lobe_device_destroy(&device);
    return hash;
}

static void a_second_renderer_adds_little(void **state) {
    fixture *f = *state;
    lobe_scene *scene = textured_scene();
    const uint64_t nothing = used_bytes(f);
    lobe_renderer *first = create_renderer(f, f->device, scene);
    const uint64_t picture = draw_hash(f, first), one = used_bytes(f) - nothing;
    lobe_renderer *second = create_renderer(f, f->device, scene);
    assert_true(draw_hash(f, second) == picture);
    const uint64_t added = used_bytes(f) - nothing - one;
    assert_true(100 * added < one);
    assert_int_equal(count_passes(lobe_renderer_graph(second), "level_reduction", LOBE_PASS_RUN),
                     0);
    assert_int_equal(
        count_passes(lobe_renderer_graph(second), "environment_prefiltering", LOBE_PASS_RUN), 0);
    assert_true(draw_hash(f, first) == picture);
    lobe_renderer_destroy(&first);
    assert_true(draw_hash(f, second) == picture);
    lobe_renderer_destroy(&second);
    assert_int_equal(used_bytes(f), nothing);
    lobe_scene_destroy(&scene);
}

/// Each renderer has a scene of its own, with the same content.
static void changes_stay_in_their_renderer(void **state) {
    static const uint32_t normals = 0;
    fixture *f = *state;
    lobe_scene *scenes[2] = {textured_scene(), textured_scene()};
    lobe_renderer *renderers[2];
    uint64_t before, after;
    for (int n = 0; n < 2; n++)
        renderers[n] = create_renderer(f, f->device, scenes[n]);
    before = draw_hash(f, renderers[0]);
    assert_true(draw_hash(f, renderers[1]) == before);
    change_normals(scenes[1]);
    after = draw_alone(f, scenes[1]);
    assert_true(after != before);
    assert_int_equal(
        lobe_renderer_update_scene(renderers[1], &(lobe_scene_changes){&normals, .image_count = 1}),
        LOBE_OK);
    for (int n = 0; n < ROUNDS; n++) {
        assert_true(draw_hash(f, renderers[0]) == before);
        assert_true(draw_hash(f, renderers[1]) == after);
    }
    lobe_renderer_destroy(&renderers[1]);
    assert_true(draw_hash(f, renderers[0]) == before);
    lobe_renderer_destroy(&renderers[0]);
    for (int n = 0; n < 2; n++)
        lobe_scene_destroy(&scenes[n]);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_second_renderer_adds_little),
        cmocka_unit_test(changes_stay_in_their_renderer),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
