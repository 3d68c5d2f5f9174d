// Motion of meshes in poses: that of rigid instances, where the pose moves all vertices alike.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { WIDTH = 40, HEIGHT = 30 };

typedef struct pose {
    float weight; ///< of a target that moves all vertices by `target_step`
    float joint[16];
} pose;

static const float target_step[3] = {0.2f, -0.1f, 0.4f};

static const pose poses[] = {
    {0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
    {0.5f, {0.8f, 0.1f, 0, 0, -0.1f, 1, 0, 0, 0.2f, 0, 0.9f, 0, 0.1f, 0.2f, 0, 1}},
    {-1, {0.9f, 0, 0.3f, 0, 0, 1.1f, 0.2f, 0, -0.2f, 0, 1, 0, -0.2f, 0.1f, 0.1f, 1}},
};

static void *allocate(size_t count, size_t size) {
    void *memory = lobe_allocate(NULL, count, size);
    assert_non_null(memory);
    return memory;
}

static lobe_scene *square(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 1);
    material.double_sided = true;
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 5);
    scene_end(scene);
    for (int i = 0; i < 3; i++) {
        scene->minimum[i] = -4;
        scene->maximum[i] = 4;
    }
    return scene;
}

static lobe_scene *posed_square(void) {
    lobe_scene *scene = square();
    lobe_mesh *mesh = &scene->meshes[0];
    lobe_deformation *d = mesh->deformation = allocate(1, sizeof *d);
    const size_t count = mesh->vertex_count;
    *d = (lobe_deformation){.target_count = 1,
                            .delta_count = count,
                            .influences_per_vertex = 1,
                            .joint_count = 1,
                            .weights = allocate(1, sizeof *d->weights),
                            .joint_matrices = allocate(1, sizeof *d->joint_matrices),
                            .first_deltas = allocate(count + 1, sizeof *d->first_deltas),
                            .deltas = allocate(count, sizeof *d->deltas),
                            .influences = allocate(count, sizeof *d->influences)};
    for (size_t i = 0; i < count; i++) {
        d->first_deltas[i + 1] = (uint32_t)i + 1;
        d->deltas[i] = (lobe_morph_delta){0};
        memcpy(d->deltas[i].position, target_step, sizeof target_step);
        d->influences[i] = (lobe_joint_influence){.joint = 0, .weight = 1};
    }
    return scene;
}

static void take_pose(lobe_scene *scene, const pose *taken) {
    lobe_deformation *d = scene->meshes[0].deformation;
    d->weights[0] = taken->weight;
    memcpy(d->joint_matrices[0], taken->joint, sizeof taken->joint);
}

/// What the pose does to a vertex, as a transform of the instance.
static void move_instance(lobe_scene *scene, const pose *taken) {
    float *transform = scene->instances[0].transform;
    memcpy(transform, taken->joint, sizeof taken->joint);
    for (int row = 0; row < 3; row++)
        for (int axis = 0; axis < 3; axis++)
            transform[12 + row] += taken->weight * taken->joint[4 * axis + row] * target_step[axis];
}

static lobe_image motion_of(fixture *f) {
    const lobe_filter *filter = filter_named("direct");
    const lobe_settings settings = settings_of(
        filter, (const char *const[]){"displacement=geometry", "pixels_per_vertex=3", NULL});
    const lobe_render_parameters wanted = {.filter = filter,
                                           .settings = &settings,
                                           .width = WIDTH,
                                           .height = HEIGHT,
                                           .motion.deliver = true};
    lobe_frame frame;
    if (lobe_renderer_render(f->renderer, &wanted, &frame) != LOBE_OK)
        fail_msg("%s", f->error);
    const lobe_image motion = frame.motion;
    frame.motion = (lobe_image){0};
    lobe_frame_free(&frame);
    return motion;
}

static size_t moving_pixels(const lobe_image *motion) {
    const float *texels = motion->texels;
    size_t count = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
        count += texels[2 * i] != 0 || texels[2 * i + 1] != 0;
    return count;
}

static void expect_motion(fixture *f, size_t least, size_t most) {
    lobe_image motion = motion_of(f);
    const size_t count = moving_pixels(&motion);
    if (count < least || count > most)
        fail_msg("%zu pixels move; expected %zu to %zu", count, least, most);
    lobe_image_free(&motion);
}

/// Motion over a sequence of poses; the caller frees the last one.
static lobe_image motion_over(fixture *f, lobe_scene *scene, const size_t order[3],
                              void (*move)(lobe_scene *, const pose *)) {
    lobe_image motion = {0};
    move(scene, &poses[order[0]]);
    if (lobe_renderer_set_scene(f->renderer, scene) != LOBE_OK)
        fail_msg("%s", f->error);
    for (size_t i = 0; i < 3; i++) {
        lobe_image_free(&motion);
        move(scene, &poses[order[i]]);
        motion = motion_of(f);
        if (i == 0)
            assert_int_equal(moving_pixels(&motion), 0);
    }
    return motion;
}

static void check_same(const lobe_image *found, const lobe_image *expected, float pixels) {
    const float *a = found->texels, *b = expected->texels;
    size_t differ = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
        differ += !(hypotf(a[2 * i] - b[2 * i], a[2 * i + 1] - b[2 * i + 1]) < pixels);
    if (differ > 3) // pixels at an edge
        fail_msg("%zu pixels move differently", differ);
}

static void poses_move_like_instances(void **state) {
    static const size_t orders[][3] = {{0, 1, 2}, {2, 1, 0}, {1, 0, 1}, {2, 0, 0}, {0, 2, 1}};
    fixture *f = *state;
    for (size_t n = 0; n < sizeof orders / sizeof *orders; n++) {
        lobe_scene *rigid = square(), *posed = posed_square();
        lobe_image expected = motion_over(f, rigid, orders[n], move_instance);
        lobe_image motion = motion_over(f, posed, orders[n], take_pose);
        check_same(&motion, &expected, 1e-3f);
        assert_true((moving_pixels(&motion) > WIDTH * HEIGHT / 20) ==
                    (orders[n][1] != orders[n][2]));
        lobe_image_free(&expected);
        lobe_image_free(&motion);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&rigid);
        lobe_scene_destroy(&posed);
    }
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static void add_relief(lobe_scene *scene) {
    scene->materials[0].height_map = scene_add_map(scene, random_map(8, 8, 0, 1, 5));
    scene->materials[0].height_scale = 0.3f;
}

/// Turned, and as far from the camera: vertices have the same heights.
static const pose turns[] = {
    {0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
    {0, {0.96f, 0.28f, 0, 0, -0.28f, 0.96f, 0, 0, 0, 0, 1, 0, 0.1f, 0, 0, 1}},
};

/// A relief moves with its mesh.
static void reliefs_move_with_poses(void **state) {
    fixture *f = *state;
    for (int i = 0; i < 2; i++) {
        lobe_image motion[2];
        for (int k = 0; k < 2; k++) {
            void (*move)(lobe_scene *, const pose *) = k == 0 ? move_instance : take_pose;
            lobe_scene *scene = k == 0 ? square() : posed_square();
            add_relief(scene);
            move(scene, &turns[i]);
            assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
            expect_motion(f, 0, 0);
            move(scene, &turns[1 - i]);
            motion[k] = motion_of(f);
            assert_true(moving_pixels(&motion[k]) > 60);
            expect_motion(f, 0, 0);
            assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
            lobe_scene_destroy(&scene);
        }
        check_same(&motion[1], &motion[0], 0.1f);
        for (int k = 0; k < 2; k++)
            lobe_image_free(&motion[k]);
    }
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static size_t deform_passes(const fixture *f) {
    const lobe_graph *graph = lobe_renderer_graph(f->renderer);
    return count_passes(graph, "deform", LOBE_PASS_RUN) +
           count_passes(graph, "deform", LOBE_PASS_SKIPPED);
}

/// A mesh that rests is not deformed twice, one that is listed as changed has not moved, and one
/// that returns to its base was where the pose had it.
static void only_poses_that_change_cost(void **state) {
    const uint32_t first = 0;
    const lobe_scene_changes changes = {.meshes = &first, .mesh_count = 1};
    fixture *f = *state;
    lobe_scene *scene = posed_square();
    take_pose(scene, &poses[1]);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    expect_motion(f, 0, 0);
    assert_int_equal(deform_passes(f), 1);
    take_pose(scene, &poses[2]);
    expect_motion(f, 60, WIDTH * HEIGHT);
    assert_int_equal(deform_passes(f), 2);
    expect_motion(f, 0, 0);
    assert_int_equal(deform_passes(f), 1);
    take_pose(scene, &poses[1]);
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    expect_motion(f, 0, 0);
    assert_int_equal(deform_passes(f), 1);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(poses_move_like_instances),
        cmocka_unit_test(reliefs_move_with_poses),
        cmocka_unit_test(only_poses_that_change_cost),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
