// Instances that are drawn together look as if each were drawn alone.

#include "passes/renderer/draw_list.h"

#include <string.h>

#include "scenes/scene/scene.h"
#include "tests/passes/renderer/culling/listed_draws.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static const uint32_t extent = 24;

static bool is_mirrored(size_t number) {
    return number % 3 == 2;
}

/// Small, apart, in turned rows; each third is mirrored.
static void place(size_t number, float transform[16]) {
    const float size = 0.1f, x = -0.8f + 0.4f * (float)(number % 5),
                z = -0.8f + 0.4f * (float)(number / 5);
    const float side = is_mirrored(number) ? -size : size;
    const float placed[16] = {0.6f * side,  0, 0.8f * side, 0, 0, size,      0, 0,
                              -0.8f * size, 0, 0.6f * size, 0, x, 0.05f * x, z, 1};
    memcpy(transform, placed, sizeof placed);
}

static lobe_material bumpy_material(lobe_scene *scene, float roughness) {
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = roughness;
    material.double_sided = true;
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, 151));
    return material;
}

enum { INSTANCES = 15 };

static uint32_t mesh_of(uint32_t instance) {
    return instance % 2;
}

static uint32_t material_of(uint32_t instance) {
    return (instance / 2 + instance) % 2;
}

static void add_alone(lobe_scene *scene, uint32_t number, const lobe_material materials[2],
                      const float transform[16]) {
    if (mesh_of(number))
        scene_add_sphere(scene, &materials[material_of(number)], 1);
    else
        scene_add_square(scene, &materials[material_of(number)], 1, NULL);
    memcpy(scene->instances[number].transform, transform, 16 * sizeof *transform);
}

/// Instances of two meshes and two materials; `alone`: each has copies of them.
static lobe_scene *crowd(bool alone) {
    lobe_scene *scene = scene_begin();
    const lobe_material materials[] = {bumpy_material(scene, 0.3f), bumpy_material(scene, 0.7f)};
    float transform[16];
    for (uint32_t i = 0; i < INSTANCES; i++) {
        place(i, transform);
        if (alone || i < 2)
            add_alone(scene, i, materials, transform);
        else
            assert_int_equal(
                scenes_add_instance(scene, mesh_of(i), material_of(i), transform, NULL), LOBE_OK);
    }
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

// ---------------------------------------------------------------------------------------------
// The list

static bool go_together(size_t a, size_t b) {
    return mesh_of((uint32_t)a) == mesh_of((uint32_t)b) &&
           material_of((uint32_t)a) == material_of((uint32_t)b) && is_mirrored(a) == is_mirrored(b);
}

/// Each instance is in the batch of the first that goes with it, and its transform is where the
/// batch's draw reads it.
static void check_list(const device_scene *scene, const draw_list *list) {
    uint32_t counts[INSTANCES] = {0}, batches = 0;
    for (size_t i = 0; i < INSTANCES; i++) {
        size_t first = 0;
        while (!go_together(first, i))
            ++first;
        batches += first == i;
        const instance_batch *batch = &list->batches[list->batch_of[i]];
        assert_int_equal(batch->instance, first);
        const struct instance_constants *transform =
            &list->transforms[batch->start + counts[list->batch_of[i]]++];
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 4; column++)
                assert_true(transform->rows[row][column] ==
                            scene->scene->instances[i].transform[4 * column + row]);
    }
    assert_int_equal(list->batch_count, batches);
    for (uint32_t i = 0; i < batches; i++)
        assert_int_equal(list->batches[i].count, counts[i]);
}

static void equal_instances_are_drawn_together(void **state) {
    lobe_scene *scene = crowd(false);
    pass_run run;
    draw_list list;
    const filtered_appearance maps[2] = {{0}};
    pass_run_begin(&run, *state, scene, "direct", (const char *[]){NULL});
    list_draws(&run, &list, maps, true);
    assert_in_range(list.batch_count, 5, 8);
    check_list(run.scene, &list);
    passes_draw_list_destroy(&list);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

static void own_maps_are_drawn_alone(void **state) {
    lobe_scene *scene = crowd(false);
    pass_run run;
    draw_list list;
    const filtered_appearance maps[INSTANCES] = {{0}};
    pass_run_begin(&run, *state, scene, "lobes", (const char *[]){NULL});
    list_draws(&run, &list, maps, false);
    assert_int_equal(list.batch_count, INSTANCES);
    for (uint32_t i = 0; i < INSTANCES; i++) {
        assert_int_equal(list.batches[i].count, 1);
        assert_ptr_equal(list.batches[i].appearance, &maps[list.batches[i].instance]);
    }
    passes_draw_list_destroy(&list);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

/// More instances than a buffer of a frame has room for.
static void long_lists_take_several_buffers(void **state) {
    enum { MANY = 100000 };
    lobe_scene *scene = crowd(false);
    float transform[16];
    for (uint32_t i = INSTANCES; i < MANY; i++) {
        place(0, transform);
        assert_int_equal(scenes_add_instance(scene, 0, 0, transform, NULL), LOBE_OK);
    }
    pass_run run;
    draw_list list;
    const filtered_appearance maps[2] = {{0}};
    pass_run_begin(&run, *state, scene, "direct", (const char *[]){NULL});
    list_draws(&run, &list, maps, true);
    uint32_t drawn = 0;
    for (uint32_t i = 0; i < list.batch_count; i++) {
        const instance_batch *batch = &list.batches[i];
        const size_t bytes = (batch->first + batch->count) * sizeof(struct instance_constants);
        assert_true(batch->transforms.version > 0 && bytes <= 4 << 20);
        drawn += batch->count;
    }
    assert_int_equal(drawn, MANY);
    passes_draw_list_destroy(&list);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// The picture

static void pictures_are_those_of_instances_drawn_alone(void **state) {
    static const char *const methods[][2] = {
        {"direct"}, {"lobes", "space=object"}, {"toksvig", "samples=4"}, {"reference"}};
    lobe_scene *together = crowd(false), *alone = crowd(true);
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        const picture_request request = {.filter = methods[i][0],
                                         .settings = {methods[i][1], NULL},
                                         .width = extent,
                                         .height = extent,
                                         .samples = 2};
        lobe_frame expected = draw_scene(*state, alone, &request),
                   frame = draw_scene(*state, together, &request);
        assert_true(largest_value(&expected.radiance) > 0.05);
        if (largest_difference(&frame.radiance, &expected.radiance) != 0)
            fail_msg("%s differs", methods[i][0]);
        lobe_frame_free(&expected);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&together);
    lobe_scene_destroy(&alone);
}

/// Hosts need not announce transforms, also where they mirror or no longer do.
static void transforms_are_those_of_the_frame(void **state) {
    fixture *f = *state;
    const picture_request request = {.filter = "toksvig", .width = extent, .height = extent};
    lobe_scene *scene = crowd(false);
    for (size_t i = 0; i < scene->material_count; i++)
        scene->materials[i].double_sided = false;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame before = draw(f, &request);
    for (size_t i = 0; i < INSTANCES; i++)
        for (int row = 0; i % 2 && row < 3; row++)
            scene->instances[i].transform[row] *= -1;
    lobe_frame frame = draw(f, &request), expected = draw_scene(f, scene, &request);
    assert_true(largest_difference(&before.radiance, &expected.radiance) > 0.01);
    assert_true(largest_difference(&frame.radiance, &expected.radiance) == 0);
    lobe_frame_free(&before);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
    lobe_scene_destroy(&scene);
}

static void grey(const double direction[3], float radiance[3]) {
    (void)direction;
    radiance[0] = radiance[1] = radiance[2] = 0.25f;
}

/// Neither hides what is behind it, nor are maps built for it, nor need it be announced.
static void hidden_instances_are_not_there(void **state) {
    static const char *const knobs[] = {NULL, "samples=4", NULL};
    fixture *f = *state;
    lobe_scene *all = crowd(false), *few = crowd(false);
    few->instance_count = 3;
    for (int i = 0; i < 3; i++) {
        if (i == 2) {
            scene_surround(all, 8, grey);
            scene_surround(few, 8, grey);
            all->environment_visible = few->environment_visible = true;
        }
        const picture_request request = {.filter = "toksvig",
                                         .settings = {"env_size=16", knobs[i]},
                                         .width = extent,
                                         .height = extent};
        lobe_frame expected = draw_scene(f, few, &request);
        for (uint32_t j = 0; j < INSTANCES; j++)
            all->instances[j].hidden = true;
        assert_int_equal(lobe_renderer_set_scene(f->renderer, all), LOBE_OK);
        lobe_frame nothing = draw(f, &request);
        assert_float_equal(largest_value(&nothing.radiance), i < 2 ? 0 : 0.25, 1e-3);
        assert_int_equal(nothing.filtered_bytes, 0);
        for (uint32_t j = 0; j < 3; j++)
            all->instances[j].hidden = false;
        lobe_frame frame = draw(f, &request);
        assert_true(largest_value(&frame.radiance) > 0.05);
        assert_true(largest_difference(&frame.radiance, &expected.radiance) == 0);
        lobe_frame_free(&nothing);
        lobe_frame_free(&frame);
        lobe_frame_free(&expected);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&all);
    lobe_scene_destroy(&few);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_instances_are_drawn_together),
        cmocka_unit_test(own_maps_are_drawn_alone),
        cmocka_unit_test(long_lists_take_several_buffers),
        cmocka_unit_test(pictures_are_those_of_instances_drawn_alone),
        cmocka_unit_test(transforms_are_those_of_the_frame),
        cmocka_unit_test(hidden_instances_are_not_there),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
