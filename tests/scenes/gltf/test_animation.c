// Animations, skins and morph targets of glTF files: what is read, and that each broken channel,
// skin or target fails with one line that names it.

#include "tests/scenes/gltf/gltf_builder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

// ---------------------------------------------------------------------------------------------
// Channels

/// One channel: what is not given is as in a sound file.
typedef struct channel_case {
    const char *what;
    const char *path, *interpolation, *target, *sampler, *node;
    gltf_component component;
    const char *type;
    bool normalised;
    size_t keys, outputs, size;
    const void *times, *values;
    const char *cause;
} channel_case;

static void write_channel(gltf_fixture *fixture, const channel_case *c) {
    static const float times[] = {0, 1}, values[] = {0, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1, 1};
    const char *type = c->type ? c->type : "VEC3";
    const size_t keys = c->keys ? c->keys : 2, outputs = c->outputs ? c->outputs : 2;
    char members[2048];
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    gltf_builder_add_floats(&builder, "SCALAR", keys, c->times ? c->times : times);
    if (c->component)
        gltf_builder_add(&builder, c->component, type, c->normalised, outputs, c->values, c->size);
    else
        gltf_builder_add_floats(&builder, type, outputs, c->values ? c->values : values);
    snprintf(members, sizeof members,
             ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{"
             "\"POSITION\":0},{\"POSITION\":0}]}]}],\"nodes\":[{\"mesh\":0},{%s}],\"animations\":["
             "{\"name\":\"walk\",\"channels\":[{\"sampler\":%s,\"target\":{\"node\":%s,"
             "\"path\":\"%s\"}}],\"samplers\":[{\"input\":1,\"output\":2,\"interpolation\":\"%s\"}"
             "]}]",
             c->node ? c->node : "", c->sampler ? c->sampler : "0", c->target ? c->target : "0",
             c->path ? c->path : "translation", c->interpolation ? c->interpolation : "LINEAR");
    gltf_builder_write(&builder, fixture, "channel.glb", members);
}

static void broken_channels_are_named(void **state) {
    const channel_case cases[] = {
        {.what = "sampler", .sampler = "1", .cause = "there is no sampler 1"},
        {.what = "node", .target = "2", .cause = "there is no node 2"},
        {.what = "matrix",
         .target = "1",
         .node = "\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]",
         .cause = "node 1 has a matrix"},
        {.what = "interpolation",
         .interpolation = "QUADRATIC",
         .cause = "unknown interpolation 'QUADRATIC'"},
        {.what = "too few outputs", .outputs = 1, .cause = "1 outputs for 2 keys of 1"},
        {.what = "too many outputs", .outputs = 3, .cause = "3 outputs for 2 keys of 1"},
        {.what = "no tangents",
         .interpolation = "CUBICSPLINE",
         .cause = "2 outputs for 2 keys of 3"},
        {.what = "NaN time", .times = (float[]){0, NAN}, .cause = "key 1 is at nan s"},
        {.what = "infinite time", .times = (float[]){0, INFINITY}, .cause = "key 1 is at inf s"},
        {.what = "negative time", .times = (float[]){-1, 0}, .cause = "key 0 is at -1 s"},
        {.what = "equal times", .times = (float[]){1, 1}, .cause = "key 1 is at 1 s, not after"},
        {.what = "decreasing times", .times = (float[]){1, 0.5f}, .cause = "not after 1 s"},
        {.what = "NaN value", .values = (float[]){0, 0, 0, 0, NAN, 0}, .cause = "output 1 is nan"},
        {.what = "huge value", .values = (float[]){1e30f, 0, 0, 0, 0, 0}, .cause = "output 0 is"},
        {.what = "wrong type", .type = "VEC4", .cause = "4 components of type 5126 are no transl"},
        {.what = "rotation of three", .path = "rotation", .cause = "are no rotation"},
        {.what = "rotation without length",
         .path = "rotation",
         .type = "VEC4",
         .values = (float[]){0, 0, 0, 1, 0, 0, 0, 0},
         .cause = "the rotation of key 1 has no length"},
        {.what = "plain integers",
         .path = "rotation",
         .type = "VEC4",
         .component = GLTF_SHORT,
         .values = (int16_t[]){0, 0, 0, 1, 0, 0, 0, 1},
         .size = 16,
         .cause = "are no rotation"},
        {.what = "integers moved",
         .component = GLTF_SHORT,
         .normalised = true,
         .values = (int16_t[]){0, 0, 0, 1, 0, 0, 0, 1},
         .size = 12,
         .cause = "are no translation"},
        {.what = "no targets",
         .path = "weights",
         .type = "SCALAR",
         .target = "1",
         .cause = "node 1 has no morph targets"},
        {.what = "too few weights",
         .path = "weights",
         .type = "SCALAR",
         .outputs = 3,
         .cause = "3 outputs for 2 keys of 2"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_channel(*state, &cases[i]);
        gltf_fixture_must_fail(*state, "channel.glb", LOBE_ERROR_MALFORMED, cases[i].cause);
        gltf_fixture_must_fail(*state, "channel.glb", LOBE_ERROR_MALFORMED,
                               "channel 0 of animation 'walk'");
    }
}

static lobe_scene *open_channel(gltf_fixture *fixture, const channel_case *c) {
    write_channel(fixture, c);
    return gltf_fixture_must_open(fixture, "channel.glb");
}

/// glTF 2.0, section 3.11: rotations and weights may be normalised integers.
static void integers_are_normalised(void **state) {
    const struct {
        gltf_component component;
        float unit; ///< of the largest
        const void *values;
        size_t size;
    } formats[] = {
        {GLTF_BYTE, 127, (int8_t[]){0, 0, 0, 127, -128, 64, 0, 1}, 8},
        {GLTF_UNSIGNED_BYTE, 255, (uint8_t[]){0, 0, 0, 255, 255, 64, 0, 1}, 8},
        {GLTF_SHORT, 32767, (int16_t[]){0, 0, 0, 32767, -32768, 64, 0, 1}, 16},
        {GLTF_UNSIGNED_SHORT, 65535, (uint16_t[]){0, 0, 0, 65535, 65535, 64, 0, 1}, 16},
    };
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        const float first = i % 2 ? 1 : -1; // the smallest number is -1 exactly
        lobe_scene *scene = open_channel(*state, &(channel_case){.path = "rotation",
                                                                 .type = "VEC4",
                                                                 .component = formats[i].component,
                                                                 .normalised = true,
                                                                 .values = formats[i].values,
                                                                 .size = formats[i].size});
        const lobe_animation_channel *channel = &scene->rig->animations[0].channels[0];
        gltf_fixture_assert_near(
            channel->values,
            (float[]){0, 0, 0, 1, first, 64 / formats[i].unit, 0, 1 / formats[i].unit}, 8, 1e-7f);
        lobe_scene_destroy(&scene);
        scene = open_channel(*state, &(channel_case){.path = "weights",
                                                     .type = "SCALAR",
                                                     .outputs = 4,
                                                     .component = formats[i].component,
                                                     .normalised = true,
                                                     .values = formats[i].values,
                                                     .size = formats[i].size / 2});
        channel = &scene->rig->animations[0].channels[0];
        assert_int_equal(channel->width, 2);
        gltf_fixture_assert_near(channel->values, (float[]){0, 0, 0, 1}, 4, 1e-7f);
        lobe_scene_destroy(&scene);
    }
}

static void unknown_properties_are_left_out(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_channel(fixture, &(channel_case){.path = "pointer"});
    assert_non_null(strstr(fixture->warnings_text, "animations of other properties"));
    assert_int_equal(scene->rig->animations[0].channel_count, 0);
    assert_int_equal(lobe_scene_set_pose(scene, NULL, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void samplers_and_targets_are_required(void **state) {
    static const struct {
        const char *animation, *cause;
    } cases[] = {
        {"{}", "animations[0]: 'channels' is missing"},
        {"{\"channels\":[]}", "animations[0]: 'samplers' is missing"},
        {"{\"channels\":[{}],\"samplers\":[]}", "animations[0].channels[0]: 'sampler' is missing"},
        {"{\"channels\":[{\"sampler\":0}],\"samplers\":[]}",
         "animations[0].channels[0]: 'target' is missing"},
        {"{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0}}],\"samplers\":[]}",
         "animations[0].channels[0].target: 'path' is missing"},
        {"{\"channels\":[],\"samplers\":[{\"input\":0}]}",
         "animations[0].samplers[0]: 'output' is missing"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text, "{\"asset\":{\"version\":\"2.0\"},\"animations\":[%s]}",
                 cases[i].animation);
        gltf_fixture_write_text(*state, "missing.gltf", text);
        gltf_fixture_must_fail(*state, "missing.gltf", LOBE_ERROR_MALFORMED, cases[i].cause);
    }
}

// ---------------------------------------------------------------------------------------------
// Skins

typedef struct skin_case {
    const char *joints;    ///< nodes
    const char *attribute; ///< instead of WEIGHTS_0
    gltf_component component;
    const void *indices;
    size_t index_size;
    const float *weights, *matrices;
    size_t matrix_count;
    const char *skin; ///< of the node
    const char *cause;
} skin_case;

static void write_skin(gltf_fixture *fixture, const skin_case *c) {
    static const uint8_t indices[12] = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    static const float weights[12] = {.5f, .5f, 0, 0, .5f, .5f, 0, 0, .5f, .5f, 0, 0};
    static const float matrices[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                       1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    char members[1024];
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    if (c->indices)
        gltf_builder_add(&builder, c->component, "VEC4", false, 3, c->indices, c->index_size);
    else
        gltf_builder_add(&builder, GLTF_UNSIGNED_BYTE, "VEC4", false, 3, indices, sizeof indices);
    gltf_builder_add_floats(&builder, "VEC4", 3, c->weights ? c->weights : weights);
    gltf_builder_add_floats(&builder, "MAT4", c->matrix_count ? c->matrix_count : 2,
                            c->matrices ? c->matrices : matrices);
    snprintf(members, sizeof members,
             ",\"meshes\":[{\"name\":\"sheet\",\"primitives\":[{\"attributes\":{\"POSITION\":0,"
             "\"JOINTS_0\":1,\"%s\":2}}]}],\"skins\":[{\"joints\":%s,\"inverseBindMatrices\":3}],"
             "\"nodes\":[{\"mesh\":0,\"skin\":%s},{},{\"translation\":[0,2,0]}]",
             c->attribute ? c->attribute : "WEIGHTS_0", c->joints ? c->joints : "[1,2]",
             c->skin ? c->skin : "0");
    gltf_builder_write(&builder, fixture, "skin.glb", members);
}

static void broken_skins_are_named(void **state) {
    const skin_case cases[] = {
        {.skin = "1", .cause = "there is no skin 1"},
        {.joints = "[1,3]", .cause = "skin 0: joint 1: there is no node 3"},
        {.joints = "[]", .cause = "skin 0: 0 joints"},
        {.joints = "[1]", .cause = "sheet: vertex 0 follows joint 1 of a skin of 1"},
        {.matrix_count = 1, .cause = "inverse bind matrices of skin 0: 1 for 2 joints"},
        {.matrices = (float[32]){[0] = NAN}, .cause = "that of joint 0 is not affine"},
        {.matrices = (float[32]){1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
         .cause = "that of joint 0 is not affine"},
        {.attribute = "WEIGHTS_1", .cause = "JOINTS_0 and WEIGHTS_0 belong together"},
        {.weights = (float[12]){1, -0.5f}, .cause = "sheet: vertex 0 has the joint weight -0.5"},
        {.weights = (float[12]){1, NAN}, .cause = "sheet: vertex 0 has the joint weight nan"},
        {.component = GLTF_FLOAT,
         .indices = (float[12]){0},
         .index_size = 48,
         .cause = "JOINTS_0 of sheet: 4 components of type 5126 are not allowed"},
        {.component = GLTF_UNSIGNED_SHORT,
         .indices = (uint16_t[12]){0, 65535},
         .index_size = 24,
         .cause = "sheet: vertex 0 follows joint 65535 of a skin of 2"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_skin(*state, &cases[i]);
        gltf_fixture_must_fail(*state, "skin.glb", LOBE_ERROR_MALFORMED, cases[i].cause);
    }
}

static void weights_are_repaired(void **state) {
    gltf_fixture *fixture = *state;
    static const float weights[12] = {0, 0, 0, 0, 3, 1, 0, 0, 0, 0.999f, 0, 0};
    // A joint of weight 0 may be anything.
    static const uint8_t joints[12] = {9, 9, 9, 9, 0, 1, 9, 9, 9, 1, 9, 9};
    write_skin(fixture, &(skin_case){.weights = weights,
                                     .component = GLTF_UNSIGNED_BYTE,
                                     .indices = joints,
                                     .index_size = 12});
    lobe_scene *scene = gltf_fixture_must_open(fixture, "skin.glb");
    assert_non_null(strstr(fixture->warnings_text, "1 vertices whose joint weights do not sum"));
    assert_non_null(strstr(fixture->warnings_text, "1 vertices of skins without joint weights"));
    const lobe_deformation *deformation = scene->meshes[0].deformation;
    static const lobe_joint_influence expected[] = {{0, 1},     {0, 0}, {0, 0.75f},
                                                    {1, 0.25f}, {1, 1}, {0, 0}};
    assert_int_equal(deformation->influences_per_vertex, 2);
    assert_true(deformation->flat);
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(deformation->influences[i].joint, expected[i].joint);
        assert_float_equal(deformation->influences[i].weight, expected[i].weight, 1e-7);
    }
    // At rest: joint 1 is two up.
    assert_true(deformation->joint_matrices[1][13] == 2);
    assert_int_equal(scene->rig->animation_count, 0);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Morph targets

static void sparse_targets_are_read(void **state) {
    static const float moved[] = {0, 0, 5};
    static const uint16_t which[] = {2};
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    gltf_builder_add_floats(&builder, "VEC3", 1, moved);
    gltf_builder_add(&builder, GLTF_UNSIGNED_SHORT, "SCALAR", false, 1, which, sizeof which);
    strcat(builder.accessors, ",{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3,\"sparse\":{"
                              "\"count\":1,\"indices\":{\"bufferView\":2,\"componentType\":5123},"
                              "\"values\":{\"bufferView\":1}}}");
    gltf_builder_write(&builder, *state, "sparse.glb",
                       ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                       "\"targets\":[{\"POSITION\":3}]}],\"weights\":[2]}],\"nodes\":[{\"mesh\":0}"
                       "]");
    lobe_scene *scene = gltf_fixture_must_open(*state, "sparse.glb");
    const lobe_deformation *deformation = scene->meshes[0].deformation;
    assert_null(scene->rig);
    assert_int_equal(deformation->delta_count, 1);
    assert_int_equal(deformation->first_deltas[2], 0);
    assert_int_equal(deformation->first_deltas[3], 1);
    assert_true(deformation->deltas[0].position[2] == 5);
    assert_true(deformation->weights[0] == 2);
    assert_true(scene->maximum[2] == 10);
    lobe_scene_destroy(&scene);
}

/// A target that turns a triangle by a right angle, and says otherwise of its tangents.
static void targets_find_their_tangents(void **state) {
    static const float normals[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const float coordinates[6] = {0, 1, 1, 1, 0, 0};
    static const float turn[9] = {0, 0, 0, -1, 1, 0, -1, -1, 0},
                       wrong[9] = {5, 5, 5, 5, 5, 5, 5, 5, 5};
    static const float tangents[12] = {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
    for (int own = 0; own < 2; own++) {
        char members[2048];
        gltf_builder builder = {0};
        gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
        gltf_builder_add_floats(&builder, "VEC3", 3, normals);
        gltf_builder_add_floats(&builder, "VEC2", 3, coordinates);
        gltf_builder_add_floats(&builder, "VEC3", 3, turn);
        gltf_builder_add_floats(&builder, "VEC3", 3, wrong);
        gltf_builder_add_floats(&builder, "VEC4", 3, tangents);
        snprintf(
            members, sizeof members,
            ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,"
            "\"TEXCOORD_0\":2%s},\"targets\":[{\"POSITION\":3,\"TANGENT\":4}],"
            "\"material\":0}]}],\"nodes\":[{\"mesh\":0}],\"materials\":[{\"normalTexture\":{"
            "\"index\":0}}],\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"data:image/"
            "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgG"
            "AWjR9awAAAABJRU5ErkJggg==\"}]",
            own ? ",\"TANGENT\":5" : "");
        gltf_builder_write(&builder, *state, "turn.glb", members);
        lobe_scene *scene = gltf_fixture_must_open(*state, "turn.glb");
        const lobe_mesh *mesh = &scene->meshes[0];
        assert_int_equal(mesh->vertex_count, 3);
        assert_int_equal(mesh->deformation->delta_count, 3);
        for (size_t i = 0; i < 3; i++) {
            const lobe_morph_delta *delta = &mesh->deformation->deltas[i];
            const float *tangent = mesh->vertices[i].tangent;
            assert_int_equal(mesh->deformation->first_deltas[i], i);
            assert_float_equal(tangent[0], 1, 1e-6);
            if (own)
                assert_memory_equal(delta->tangent, wrong + 3 * i, sizeof delta->tangent);
            else
                for (int axis = 0; axis < 3; axis++)
                    assert_float_equal(tangent[axis] + delta->tangent[axis], axis == 1, 1e-6);
        }
        lobe_scene_destroy(&scene);
    }
}

static void broken_targets_are_named(void **state) {
    static const struct {
        const char *mesh, *node, *cause;
    } cases[] = {
        {"\"targets\":[{\"POSITION\":9}]}]", "",
         "POSITION of morph target 0 of mesh 0: there is "
         "no accessor 9"},
        {"\"targets\":[{},{\"NORMAL\":1}]}]", "", "NORMAL of morph target 1 of mesh 0: 2 elements"},
        {"\"targets\":[{\"TANGENT\":2}]}]", "", "4 components of type 5126 are not allowed"},
        {"\"targets\":[{\"POSITION\":3}]}]", "", "vertex 1 of morph target 0 is out of range"},
        {"\"targets\":[{\"POSITION\":0}]}],\"weights\":[1,2]", "",
         "mesh 0: 2 weights for 1 morph targets"},
        {"\"targets\":[{\"POSITION\":0}]}]", ",\"weights\":[1,2]",
         "node 0: 2 weights for 1 morph targets"},
        {"\"targets\":[{\"POSITION\":0}]}],\"weights\":[1e30]", "",
         "mesh 0: morph weight 0 is out of range"},
        {"\"targets\":[{\"POSITION\":0}]},{\"attributes\":{\"POSITION\":0}}]", "",
         "mesh 0: its primitives have 1 and 0 morph targets"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char members[1024];
        gltf_builder builder = {0};
        gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
        gltf_builder_add_floats(&builder, "VEC3", 2, triangle);
        gltf_builder_add_floats(&builder, "VEC4", 3, (float[12]){0});
        gltf_builder_add_floats(&builder, "VEC3", 3, (float[9]){[4] = NAN});
        snprintf(members, sizeof members,
                 ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},%s}],\"nodes\":[{"
                 "\"mesh\":0%s}]",
                 cases[i].mesh, cases[i].node);
        gltf_builder_write(&builder, *state, "target.glb", members);
        gltf_fixture_must_fail(*state, "target.glb", LOBE_ERROR_MALFORMED, cases[i].cause);
    }
}

/// Tangents that split a vertex also split what deforms it.
static void split_vertices_keep_their_deformation(void **state) {
    // Two triangles on one edge, whose texture coordinates are mirrored.
    static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0};
    static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const float coordinates[] = {0, 0, 1, 0, 0, 1, 1, 0};
    static const float deltas[] = {0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4};
    static const uint8_t joints[] = {0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0};
    static const float weights[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    static const uint16_t indices[] = {0, 1, 2, 0, 2, 3};
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 4, positions);
    gltf_builder_add_floats(&builder, "VEC3", 4, normals);
    gltf_builder_add_floats(&builder, "VEC2", 4, coordinates);
    gltf_builder_add_floats(&builder, "VEC3", 4, deltas);
    gltf_builder_add(&builder, GLTF_UNSIGNED_BYTE, "VEC4", false, 4, joints, sizeof joints);
    gltf_builder_add_floats(&builder, "VEC4", 4, weights);
    gltf_builder_add(&builder, GLTF_UNSIGNED_SHORT, "SCALAR", false, 6, indices, sizeof indices);
    gltf_builder_write(&builder, *state, "split.glb",
                       ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,"
                       "\"TEXCOORD_0\":2,\"JOINTS_0\":4,\"WEIGHTS_0\":5},\"indices\":6,"
                       "\"targets\":[{\"POSITION\":3}]}],\"weights\":[1]}],\"skins\":[{"
                       "\"joints\":[0,1,2,3]}],\"nodes\":[{\"mesh\":0,\"skin\":0},{},{},{}]");
    lobe_scene *scene = gltf_fixture_must_open(*state, "split.glb");
    const lobe_mesh *mesh = &scene->meshes[0];
    const lobe_deformation *deformation = mesh->deformation;
    assert_int_equal(mesh->vertex_count, 6);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *position = mesh->vertices[i].position;
        const uint32_t origin =
            position[1] > 0 ? 2 : (position[0] > 0 ? 1 : (position[0] < 0 ? 3 : 0));
        assert_int_equal(deformation->influences[i].joint, origin);
        assert_int_equal(deformation->first_deltas[i + 1] - deformation->first_deltas[i], 1);
        assert_true(deformation->deltas[deformation->first_deltas[i]].position[2] ==
                    (float)origin + 1);
    }
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(broken_channels_are_named),
        cmocka_unit_test(integers_are_normalised),
        cmocka_unit_test(unknown_properties_are_left_out),
        cmocka_unit_test(samplers_and_targets_are_required),
        cmocka_unit_test(broken_skins_are_named),
        cmocka_unit_test(weights_are_repaired),
        cmocka_unit_test(sparse_targets_are_read),
        cmocka_unit_test(targets_find_their_tangents),
        cmocka_unit_test(broken_targets_are_named),
        cmocka_unit_test(split_vertices_keep_their_deformation),
    };
    return cmocka_run_group_tests(tests, gltf_fixture_setup, gltf_fixture_teardown);
}
