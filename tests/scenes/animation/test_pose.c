// Poses of scenes: against transforms composed in another way and in double precision.

#include "tests/scenes/gltf/gltf_builder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/scenes/animation/pose_reference.h"

static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static lobe_scene *open_built(gltf_fixture *fixture, const gltf_builder *builder,
                              const char *members) {
    gltf_builder_write(builder, fixture, "pose.glb", members);
    return gltf_fixture_must_open(fixture, "pose.glb");
}

static void pose(lobe_scene *scene, size_t animation, double seconds) {
    assert_int_equal(
        lobe_scene_set_pose(scene, &(lobe_pose){.animation = animation, .seconds = seconds}, NULL),
        LOBE_OK);
}

// ---------------------------------------------------------------------------------------------
// Nodes

/// A mesh on node 2, below node 1 (which moves along x, by a step and a spline), below node 0,
/// which turns about z by a right angle in two seconds; the second animation scales node 2.
static lobe_scene *open_nodes(gltf_fixture *fixture) {
    gltf_builder builder = {0};
    const float s = 0.70710678118654752f;
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    gltf_builder_add_floats(&builder, "SCALAR", 2, (float[]){0, 2});
    gltf_builder_add_floats(&builder, "VEC4", 2, (float[]){0, 0, 0, 1, 0, 0, s, s});
    gltf_builder_add_floats(&builder, "VEC3", 6,
                            (float[]){0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0});
    gltf_builder_add_floats(&builder, "VEC3", 2, (float[]){1, 1, 1, 2, 3, 4});
    return open_built(
        fixture, &builder,
        ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":["
        "{\"children\":[1]},{\"children\":[2],\"translation\":[9,9,9]},{\"mesh\":0,"
        "\"translation\":[0,0,5]},{\"mesh\":0,\"translation\":[7,0,0]}],\"animations\":["
        "{\"name\":\"turn\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
        "\"rotation\"}},{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"translation\"}}],"
        "\"samplers\":[{\"input\":1,\"output\":2},{\"input\":1,\"output\":3,"
        "\"interpolation\":\"CUBICSPLINE\"}]},{\"channels\":[{\"sampler\":0,\"target\":{"
        "\"node\":2,\"path\":\"scale\"}}],\"samplers\":[{\"input\":1,\"output\":4,"
        "\"interpolation\":\"STEP\"}]}]");
}

static void assert_transform(const lobe_scene *scene, size_t instance, const double expected[16]) {
    for (int i = 0; i < 16; i++)
        if (!(fabs(scene->instances[instance].transform[i] - expected[i]) < 1e-6))
            fail_msg("element %d is %g instead of %g", i,
                     (double)scene->instances[instance].transform[i], expected[i]);
}

static void expect_nodes(const lobe_scene *scene, double seconds) {
    const double angle = M_PI / 4 * seconds, c = cos(angle), s = sin(angle), t = seconds / 2;
    const double x = 1 + 2 * (3 * t * t - 2 * t * t * t); // from 1 to 3, at rest at both ends
    assert_transform(scene, 0, (double[]){c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, c * x, s * x, 5, 1});
}

static void nodes_follow_their_channels(void **state) {
    lobe_scene *scene = open_nodes(*state);
    assert_non_null(scene->rig);
    assert_int_equal(scene->rig->animation_count, 2);
    assert_string_equal(scene->rig->animations[0].name, "turn");
    assert_true(scene->rig->animations[0].duration == 2);
    assert_int_equal(scene->rig->instance_count, 1); // the other instance does not move
    assert_transform(scene, 0, (double[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 9, 9, 14, 1});
    for (double seconds = 0; seconds < 2; seconds += 0.0625) {
        pose(scene, 0, seconds);
        expect_nodes(scene, seconds);
        assert_transform(scene, 1, (double[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1});
    }
    assert_int_equal(lobe_scene_set_pose(scene, NULL, NULL), LOBE_OK);
    expect_nodes(scene, 0);
    lobe_scene_destroy(&scene);
}

static void time_repeats_or_stands_still(void **state) {
    lobe_scene *scene = open_nodes(*state);
    for (int turn = -3; turn <= 3; turn++) {
        pose(scene, 0, 0.625 + 2 * turn);
        expect_nodes(scene, 0.625);
        lobe_pose once = {.seconds = 0.625 + 2 * turn, .once = true};
        assert_int_equal(lobe_scene_set_pose(scene, &once, NULL), LOBE_OK);
        expect_nodes(scene, turn < 0 ? 0 : turn > 0 ? 2 : 0.625);
    }
    pose(scene, 0, 2);
    expect_nodes(scene, 0);
    pose(scene, 0, 1e15 + 1);
    expect_nodes(scene, 1);
    lobe_scene_destroy(&scene);
}

static void animations_are_chosen(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_nodes(fixture);
    size_t index = 5;
    assert_int_equal(lobe_scene_find_animation(scene, "turn", NULL, &index), LOBE_OK);
    assert_int_equal(index, 0);
    assert_int_equal(lobe_scene_find_animation(scene, "walk", NULL, &index), LOBE_ERROR_NOT_FOUND);
    assert_int_equal(index, 0);
    // The second holds its first key until 2 s, where it begins again: at its end only once.
    lobe_pose end = {.animation = 1, .seconds = 2, .once = true};
    assert_int_equal(lobe_scene_set_pose(scene, &end, NULL), LOBE_OK);
    assert_transform(scene, 0, (double[]){2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 9, 9, 14, 1});
    end.animation = LOBE_ANIMATION_ALL;
    assert_int_equal(lobe_scene_set_pose(scene, &end, NULL), LOBE_OK);
    assert_transform(scene, 0, (double[]){0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 0, 3, 5, 1});
    pose(scene, LOBE_ANIMATION_NONE, 17);
    assert_transform(scene, 0, (double[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 9, 9, 14, 1});
    assert_int_equal(lobe_scene_set_pose(scene, &(lobe_pose){.animation = 2}, NULL),
                     LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(lobe_scene_set_pose(scene, &(lobe_pose){.seconds = NAN}, NULL),
                     LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(lobe_scene_set_pose(NULL, NULL, NULL), LOBE_ERROR_INVALID_ARGUMENT);
    assert_transform(scene, 0, (double[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 9, 9, 14, 1});
    lobe_scene_destroy(&scene);
}

static void scenes_without_motion_stay(void **state) {
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    lobe_scene *scene =
        open_built(*state, &builder,
                   ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                   "\"nodes\":[{\"mesh\":0}]");
    assert_null(scene->rig);
    assert_null(scene->meshes[0].deformation);
    assert_int_equal(lobe_scene_set_pose(scene, NULL, NULL), LOBE_OK);
    assert_int_equal(lobe_scene_set_pose(scene, &(lobe_pose){0}, NULL),
                     LOBE_ERROR_INVALID_ARGUMENT);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Cameras, lights, scaling

/// A node with a light, a camera and a mirrored mesh, which moves by (1, 2, 3) a second and shrinks
/// to nothing at one second.
static lobe_scene *open_carried(gltf_fixture *fixture) {
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    gltf_builder_add_floats(&builder, "SCALAR", 2, (float[]){0, 2});
    gltf_builder_add_floats(&builder, "VEC3", 2, (float[]){0, 0, 0, 2, 4, 6});
    gltf_builder_add_floats(&builder, "VEC3", 2, (float[]){1, -1, 1, -1, 1, -1});
    return open_built(
        fixture, &builder,
        ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"cameras\":[{"
        "\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0.1}}],"
        "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":"
        "{\"lights\":[{\"type\":\"spot\",\"spot\":{}}]}},\"nodes\":[{\"camera\":0,"
        "\"children\":[1,2],\"rotation\":[0,0.70710678,0,0.70710678]},{\"mesh\":0,"
        "\"scale\":[1,-1,1]},{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],"
        "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
        "\"translation\"}},{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"scale\"}}],"
        "\"samplers\":[{\"input\":1,\"output\":2},{\"input\":1,\"output\":3}]}]");
}

static void cameras_and_lights_are_carried(void **state) {
    lobe_scene *scene = open_carried(*state);
    const float distance = (float)scene->rig->camera_distance;
    assert_true(distance > 0);
    for (double seconds = 0; seconds < 2; seconds += 0.25) {
        const float t = (float)seconds;
        pose(scene, 0, seconds);
        // Turned by a right angle about y, -z is -x.
        gltf_fixture_assert_near(scene->camera.eye, (float[]){t, 2 * t, 3 * t}, 3, 1e-6f);
        gltf_fixture_assert_near(scene->camera.target, (float[]){t - distance, 2 * t, 3 * t}, 3,
                                 1e-5f);
        gltf_fixture_assert_near(scene->camera.up, (float[]){0, 1, 0}, 3, 1e-6f);
        gltf_fixture_assert_near(scene->lights[0].position, (float[]){t, 2 * t, 3 * t}, 3, 1e-6f);
        gltf_fixture_assert_near(scene->lights[0].direction, (float[]){-1, 0, 0}, 3, 1e-6f);
    }
    lobe_scene_destroy(&scene);
}

static double determinant(const float *m) {
    return m[0] * ((double)m[5] * m[10] - (double)m[6] * m[9]) -
           m[4] * ((double)m[1] * m[10] - (double)m[2] * m[9]) +
           m[8] * ((double)m[1] * m[6] - (double)m[2] * m[5]);
}

static void what_shrinks_to_nothing_is_hidden(void **state) {
    lobe_scene *scene = open_carried(*state);
    const lobe_instance *instance = &scene->instances[0];
    for (int turn = 0; turn < 2; turn++) {
        pose(scene, 0, 0.5);
        assert_false(instance->hidden);
        assert_true(determinant(instance->transform) > 0); // the mesh is the mirrored one
        pose(scene, 0, 1);
        assert_true(instance->hidden);
        assert_true(determinant(instance->transform) > 0);
        gltf_fixture_assert_near(instance->transform + 12, (float[]){1, 2, 3}, 3, 1e-6f);
        gltf_fixture_assert_near(scene->minimum, (float[]){1, 2, 3}, 3, 1e-5f);
        gltf_fixture_assert_near(scene->maximum, (float[]){1, 2, 3}, 3, 1e-5f);
        pose(scene, 0, 1.5);
        assert_false(instance->hidden); // turned over in x and z instead of y
        assert_true(determinant(instance->transform) < 0);
    }
    // A host's own hiding stays.
    scene->instances[0].hidden = true;
    pose(scene, 0, 0.25);
    assert_true(instance->hidden);
    lobe_scene_destroy(&scene);
}

static void what_is_flat_at_rest_can_grow(void **state) {
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    gltf_builder_add_floats(&builder, "SCALAR", 2, (float[]){0, 1});
    gltf_builder_add_floats(&builder, "VEC3", 2, (float[]){0, 0, 0, 1, 1, 1});
    lobe_scene *scene = open_built(
        *state, &builder,
        ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{"
        "\"mesh\":0,\"scale\":[0,0,0]},{\"mesh\":0}],\"animations\":[{\"channels\":[{"
        "\"sampler\":0,\"target\":{\"node\":0,\"path\":\"scale\"}}],\"samplers\":[{\"input\":1,"
        "\"output\":2}]}]");
    assert_int_equal(scene->instance_count, 2);
    assert_true(scene->instances[0].hidden);
    pose(scene, 0, 0.5);
    assert_false(scene->instances[0].hidden);
    assert_transform(scene, 0, (double[]){.5, 0, 0, 0, 0, .5, 0, 0, 0, 0, .5, 0, 0, 0, 0, 1});
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Skins and morph targets

/// A strip of four vertices that two joints bend, with two morph targets; `scale`: of the node
/// above the joints, in x.
static lobe_scene *open_skinned(gltf_fixture *fixture, double scale) {
    static const float positions[] = {0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0};
    static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const uint8_t joints[] = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    static const float weights[] = {1, 0, 0, 0, 1, 0, 0, 0, .25f, .75f, 0, 0, 0.5f, 1.5f, 0, 0};
    static const uint16_t indices[] = {0, 1, 2, 0, 2, 3};
    static const float target_0[] = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0};
    static const float target_1[] = {0, 0, 0, 0, 0, 0, 0, 0, -2, 0, 0, 0};
    const float s = 0.70710678118654752f;
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 4, positions);
    gltf_builder_add_floats(&builder, "VEC3", 4, normals);
    gltf_builder_add(&builder, GLTF_UNSIGNED_BYTE, "VEC4", false, 4, joints, sizeof joints);
    gltf_builder_add_floats(&builder, "VEC4", 4, weights);
    gltf_builder_add(&builder, GLTF_UNSIGNED_SHORT, "SCALAR", false, 6, indices, sizeof indices);
    gltf_builder_add_floats(&builder, "VEC3", 4, target_0);
    gltf_builder_add_floats(&builder, "VEC3", 4, target_1);
    // Joint 1 is bound at (0, 1, 0).
    gltf_builder_add_floats(&builder, "MAT4", 2,
                            (float[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                      1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
    gltf_builder_add_floats(&builder, "SCALAR", 2, (float[]){0, 2});
    gltf_builder_add_floats(&builder, "VEC4", 2, (float[]){0, 0, 0, 1, 0, 0, s, s});
    gltf_builder_add_floats(&builder, "SCALAR", 4, (float[]){0, 0, 1, 3});
    char members[2048];
    snprintf(members, sizeof members,
             ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,"
             "\"JOINTS_0\":2,\"WEIGHTS_0\":3},\"indices\":4,\"targets\":[{\"POSITION\":5},{"
             "\"POSITION\":6}]}]}],\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":7}],"
             "\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[50,0,0],\"weights\":[0.5,0]},"
             "{\"children\":[2],\"scale\":[%g,1,1],\"translation\":[0,0,10]},{\"translation\":"
             "[0,1,0]}],\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,"
             "\"path\":\"rotation\"}},{\"sampler\":1,\"target\":{\"node\":0,\"path\":"
             "\"weights\"}}],\"samplers\":[{\"input\":8,\"output\":9},{\"input\":8,\"output\":"
             "10}]}]",
             scale);
    return open_built(fixture, &builder, members);
}

/// Where vertex (x, y, z), bent by `part` at joint 1, comes to.
static void bend(double scale, double seconds, double part, const double p[3], double out[3]) {
    const double angle = M_PI / 4 * seconds, c = cos(angle), s = sin(angle);
    const double x = c * p[0] - s * (p[1] - 1), y = s * p[0] + c * (p[1] - 1) + 1;
    out[0] = scale * (part * x + (1 - part) * p[0]);
    out[1] = part * y + (1 - part) * p[1];
    out[2] = p[2] + 10;
}

static void in_the_world(const lobe_scene *scene, const lobe_scene_vertex *vertex, double out[3]) {
    const float *m = scene->instances[0].transform, *p = vertex->position;
    for (int row = 0; row < 3; row++)
        out[row] = (double)m[row] * p[0] + (double)m[4 + row] * p[1] + (double)m[8 + row] * p[2] +
                   m[12 + row];
}

static void assert_bent(const lobe_scene *scene, double scale, double seconds) {
    static const double parts[] = {0, 0, 0.75, 0.75};
    const double first = seconds / 2, second = 1.5 * seconds;
    const double base[4][3] = {
        {0, 0, 0}, {1, 0, 0}, {1, 2 + first, -2 * second}, {0, 2 + first, 0}};
    for (size_t i = 0; i < 4; i++) {
        lobe_scene_vertex vertex;
        double expected[3], found[3];
        bend(scale, seconds, parts[i], base[i], expected);
        pose_reference(&scene->meshes[0], i, &vertex);
        in_the_world(scene, &vertex, found);
        for (int axis = 0; axis < 3; axis++) {
            if (!(fabs(found[axis] - expected[axis]) < 2e-6))
                fail_msg("at %g s, vertex %zu is at %g instead of %g", seconds, i, found[axis],
                         expected[axis]);
            assert_true(found[axis] >= scene->minimum[axis] - 1e-5 &&
                        found[axis] <= scene->maximum[axis] + 1e-5);
        }
    }
}

static void skins_bend_and_targets_morph(void **state) {
    gltf_fixture *fixture = *state;
    for (double scale = -2; scale < 3; scale += 1.5) { // also mirrored
        lobe_scene *scene = open_skinned(fixture, scale);
        // One vertex has weights that sum to 2.
        assert_non_null(strstr(fixture->warnings_text, "do not sum to 1"));
        const lobe_deformation *deformation = scene->meshes[0].deformation;
        assert_non_null(deformation);
        assert_int_equal(deformation->influences_per_vertex, 2);
        assert_int_equal(deformation->delta_count, 3);
        assert_true(deformation->weights[0] == 0.5f);
        for (double seconds = 0; seconds < 2; seconds += 0.125) {
            pose(scene, 0, seconds);
            assert_bent(scene, scale, seconds);
            assert_int_equal(determinant(scene->instances[0].transform) < 0, scale < 0);
            // The skin's own matrices then keep triangles as they are.
            assert_true(determinant(deformation->joint_matrices[1]) > 0);
        }
        lobe_scene_destroy(&scene);
    }
}

/// Bounds are those of a few boxes, not larger by orders of magnitude.
static void bounds_are_tight(void **state) {
    lobe_scene *scene = open_skinned(*state, 1);
    pose(scene, LOBE_ANIMATION_NONE, 0);
    gltf_fixture_assert_near(scene->minimum, (float[]){0, 0, 10}, 3, 1e-5f);
    gltf_fixture_assert_near(scene->maximum, (float[]){1, 2.5f, 10}, 3, 1e-5f);
    pose(scene, 0, 1);
    assert_true(scene->maximum[1] < 6 && scene->minimum[0] > -4 && scene->maximum[0] < 3);
    lobe_scene_destroy(&scene);
}

/// Nodes that share a mesh but not its weights have meshes of their own.
static void nodes_have_weights_of_their_own(void **state) {
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    gltf_builder_add_floats(&builder, "SCALAR", 2, (float[]){0, 1});
    gltf_builder_add_floats(&builder, "SCALAR", 2, (float[]){0, 1});
    lobe_scene *scene = open_built(
        *state, &builder,
        ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{"
        "\"POSITION\":1}]}],\"weights\":[0.25]}],\"nodes\":[{\"mesh\":0},{\"mesh\":0},{\"mesh\":0,"
        "\"weights\":[2]},{\"mesh\":0}],\"animations\":[{\"channels\":[{\"sampler\":0,"
        "\"target\":{\"node\":3,\"path\":\"weights\"}}],\"samplers\":[{\"input\":2,\"output\":"
        "3}]}]");
    const float expected[] = {0.25f, 0.25f, 2, 0.5f};
    pose(scene, 0, 0.5);
    assert_int_equal(scene->mesh_count, 3);
    for (int i = 0; i < 4; i++) {
        const lobe_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        assert_true(mesh->deformation->weights[0] == expected[i]);
        assert_true(mesh->deformation->flat);
        assert_true(mesh->maximum[0] == 1 + expected[i]);
    }
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Rigs of a host's

typedef void (*mistake)(lobe_rig *rig);

static void loop_parents(lobe_rig *rig) {
    rig->nodes[1].parent = 1;
}
static void lose_parent(lobe_rig *rig) {
    rig->nodes[1].parent = -2;
}
static void lose_node(lobe_rig *rig) {
    rig->animations[0].channels[0].target = 3;
}
static void lose_keys(lobe_rig *rig) {
    rig->animations[0].channels[0].key_count = 0;
}
static void widen(lobe_rig *rig) {
    rig->animations[0].channels[0].width = 5;
}
static void lose_path(lobe_rig *rig) {
    rig->animations[0].channels[0].path = LOBE_CHANNEL_PATH_COUNT;
}
static void lose_joint(lobe_rig *rig) {
    rig->skins[0].joints[1] = 3;
}
static void lose_skin(lobe_rig *rig) {
    rig->meshes[0].skin = 1;
}
static void lose_mesh(lobe_rig *rig) {
    rig->meshes[0].mesh = 1;
}
static void lose_instance(lobe_rig *rig) {
    rig->instances[0].instance = 1;
}
static void lose_camera(lobe_rig *rig) {
    rig->camera_node = 3;
}
static void empty_rotation(lobe_rig *rig) {
    memset(rig->nodes[1].rotation, 0, sizeof rig->nodes[1].rotation);
}
static void forget_number(lobe_rig *rig) {
    rig->nodes[1].translation[0] = NAN;
}
static void go_far(lobe_rig *rig) {
    rig->nodes[1].translation[0] = 2e18f;
}
static void forget_weight(lobe_rig *rig) {
    rig->animations[0].channels[1].values[0] = NAN;
}
static void forget_matrix(lobe_rig *rig) {
    rig->skins[0].inverse_bind_matrices[1][5] = INFINITY;
}

static void mistakes_leave_the_scene(void **state) {
    static const struct {
        mistake make;
        lobe_result result;
    } cases[] = {
        {loop_parents, LOBE_ERROR_MALFORMED}, {lose_parent, LOBE_ERROR_MALFORMED},
        {lose_node, LOBE_ERROR_MALFORMED},    {lose_keys, LOBE_ERROR_MALFORMED},
        {widen, LOBE_ERROR_MALFORMED},        {lose_path, LOBE_ERROR_MALFORMED},
        {lose_joint, LOBE_ERROR_MALFORMED},   {lose_skin, LOBE_ERROR_MALFORMED},
        {lose_mesh, LOBE_ERROR_MALFORMED},    {lose_instance, LOBE_ERROR_MALFORMED},
        {lose_camera, LOBE_ERROR_MALFORMED},  {empty_rotation, LOBE_ERROR_MALFORMED},
        {forget_number, LOBE_ERROR_LIMIT},    {go_far, LOBE_ERROR_LIMIT},
        {forget_weight, LOBE_ERROR_LIMIT},    {forget_matrix, LOBE_ERROR_LIMIT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lobe_scene *scene = open_skinned(*state, 1);
        float before[2][16];
        memcpy(before, scene->meshes[0].deformation->joint_matrices, sizeof before);
        cases[i].make(scene->rig);
        const lobe_result result = lobe_scene_set_pose(scene, NULL, NULL);
        if (result != cases[i].result)
            fail_msg("case %zu: %s", i, lobe_result_name(result));
        assert_memory_equal(before, scene->meshes[0].deformation->joint_matrices, sizeof before);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_follow_their_channels),
        cmocka_unit_test(time_repeats_or_stands_still),
        cmocka_unit_test(animations_are_chosen),
        cmocka_unit_test(scenes_without_motion_stay),
        cmocka_unit_test(cameras_and_lights_are_carried),
        cmocka_unit_test(what_shrinks_to_nothing_is_hidden),
        cmocka_unit_test(what_is_flat_at_rest_can_grow),
        cmocka_unit_test(skins_bend_and_targets_morph),
        cmocka_unit_test(bounds_are_tight),
        cmocka_unit_test(nodes_have_weights_of_their_own),
        cmocka_unit_test(mistakes_leave_the_scene),
    };
    return cmocka_run_group_tests(tests, gltf_fixture_setup, gltf_fixture_teardown);
}
