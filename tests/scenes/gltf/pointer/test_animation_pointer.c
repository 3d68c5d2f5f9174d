// Animations of materials, lights and nodes by pointers (KHR_animation_pointer): what each moves,
// what stays, and that each pointer to nothing fails with one line that names it.

#include "tests/scenes/gltf/gltf_builder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/// A file with two materials, a spot light and a node, and two animations of two keys, 0 s and 2 s:
/// the first has a channel for each of `count` pointers, the second none but a node's.
static void write_pointers(gltf_fixture *fixture, const char *const *pointers, size_t count,
                           const char *type, const float *values) {
    char members[16384], targets[4096] = "";
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, triangle);
    gltf_builder_add_floats(&builder, "SCALAR", 2, (float[]){0, 2});
    gltf_builder_add_floats(&builder, type, 2, values);
    gltf_builder_add_floats(&builder, "VEC3", 2, (float[]){0, 0, 0, 1, 1, 1});
    for (size_t i = 0; i < count; i++)
        snprintf(targets + strlen(targets), sizeof targets - strlen(targets),
                 "%s{\"sampler\":0,\"target\":{ \"path\":\"pointer\",\"extensions\":{"
                 "\"KHR_animation_pointer\":{\"pointer\":\"%s\"}}}}",
                 i > 0 ? "," : "", pointers[i]);
    snprintf(
        members, sizeof members,
        ",\"extensionsUsed\":[\"KHR_animation_pointer\"],\"extensionsRequired\":["
        "\"KHR_animation_pointer\"],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
        "\"material\":0}]}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,"
        "0.25,0.125,1],\"metallicFactor\":0,\"roughnessFactor\":0.5,\"baseColorTexture\":{"
        "\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0],\"scale\":[2,"
        "4]}}}},\"emissiveFactor\":[0.25,0.5,1],\"extensions\":{"
        "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":2}}},{}],\"textures\":[{}],"
        "\"nodes\":[{\"mesh\":0},{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],"
        "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"intensity\":3,"
        "\"color\":[1,0.5,0.25],\"spot\":{\"innerConeAngle\":0.2,\"outerConeAngle\":0.5}}]}},"
        "\"animations\":[{\"name\":\"glow\",\"channels\":[%s],\"samplers\":[{\"input\":1,"
        "\"output\":2}]},{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
        "\"translation\"}}],\"samplers\":[{\"input\":1,\"output\":3}]}]",
        targets);
    gltf_builder_write(&builder, fixture, "pointer.glb", members);
}

static lobe_scene *open_pointer(gltf_fixture *fixture, const char *pointer, const char *type,
                                const float *values) {
    write_pointers(fixture, &pointer, 1, type, values);
    return gltf_fixture_must_open(fixture, "pointer.glb");
}

static void pose(lobe_scene *scene, size_t animation, double seconds) {
    assert_int_equal(
        lobe_scene_set_pose(
            scene, &(lobe_pose){.animation = animation, .seconds = seconds, .once = true}, NULL),
        LOBE_OK);
}

// ---------------------------------------------------------------------------------------------
// What pointers move

/// A part of the scene, as numbers.
typedef void (*reader)(const lobe_scene *scene, float *numbers);

static void read_colour(const lobe_scene *scene, float *numbers) {
    memcpy(numbers, scene->materials[0].base_colour, 4 * sizeof *numbers);
}
static void read_metallic(const lobe_scene *scene, float *numbers) {
    numbers[0] = scene->materials[0].metallic;
}
static void read_roughness(const lobe_scene *scene, float *numbers) {
    numbers[0] = scene->materials[0].roughness;
}
static void read_emission(const lobe_scene *scene, float *numbers) {
    memcpy(numbers, scene->materials[0].emissive, 3 * sizeof *numbers);
}
static void read_normal_scale(const lobe_scene *scene, float *numbers) {
    numbers[0] = scene->materials[0].normal_scale;
}
static void read_occlusion(const lobe_scene *scene, float *numbers) {
    numbers[0] = scene->materials[0].occlusion_strength;
}
static void read_cutoff(const lobe_scene *scene, float *numbers) {
    numbers[0] = scene->materials[0].alpha_cutoff;
}
static void read_place(const lobe_scene *scene, float *numbers) {
    memcpy(numbers, scene->materials[0].base_colour_map.transform, 6 * sizeof *numbers);
}
static void read_normal_place(const lobe_scene *scene, float *numbers) {
    memcpy(numbers, scene->materials[0].normal_map.transform, 6 * sizeof *numbers);
}
static void read_light(const lobe_scene *scene, float *numbers) {
    memcpy(numbers, scene->lights[0].intensity, 3 * sizeof *numbers);
    numbers[3] = scene->lights[0].range;
    numbers[4] = scene->lights[0].inner_cone;
    numbers[5] = scene->lights[0].outer_cone;
}
static void read_node(const lobe_scene *scene, float *numbers) {
    memcpy(numbers, scene->instances[0].transform + 12, 3 * sizeof *numbers);
}

#define PBR   "/materials/0/pbrMetallicRoughness/"
#define LIGHT "/extensions/KHR_lights_punctual/lights/0/"
#define PLACE "/extensions/KHR_texture_transform/"

static const struct pointer_case {
    const char *pointer, *type;
    float values[8]; ///< of both keys
    reader read;
    size_t count;
    float rest[6], middle[6]; ///< after one of the two seconds
} cases[] = {
    {PBR "baseColorFactor",
     "VEC4",
     {0, 0, 0, 0, 1, 0.5, 0, 1},
     read_colour,
     4,
     {0.5, 0.25, 0.125, 1},
     {0.5, 0.25, 0, 0.5}},
    {PBR "metallicFactor", "SCALAR", {0, 1}, read_metallic, 1, {0}, {0.5}},
    {PBR "roughnessFactor", "SCALAR", {0.5, 1}, read_roughness, 1, {0.5}, {0.75}},
    {PBR "roughnessFactor", "SCALAR", {1, 3}, read_roughness, 1, {0.5}, {1}}, // clamped
    {PBR "metallicFactor", "SCALAR", {-3, 1}, read_metallic, 1, {0}, {0}},    // clamped
    {"/materials/0/emissiveFactor",
     "VEC3",
     {0, 0, 0, 2, 1, 0},
     read_emission,
     3,
     {0.5, 1, 2},
     {2, 1, 0}},
    {"/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength",
     "SCALAR",
     {0, 8},
     read_emission,
     3,
     {0.5, 1, 2},
     {1, 2, 4}},
    {"/materials/0/normalTexture/scale", "SCALAR", {-2, 0}, read_normal_scale, 1, {1}, {-1}},
    {"/materials/0/occlusionTexture/strength", "SCALAR", {0, 1}, read_occlusion, 1, {1}, {0.5}},
    {"/materials/0/alphaCutoff", "SCALAR", {0, 1}, read_cutoff, 1, {0.5}, {0.5}},
    {LIGHT "color", "VEC3", {0, 0, 0, 2, 2, 2}, read_light, 3, {3, 1.5, 0.75}, {3, 3, 3}},
    {LIGHT "intensity", "SCALAR", {0, 2}, read_light, 3, {3, 1.5, 0.75}, {1, 0.5, 0.25}},
    {LIGHT "range", "SCALAR", {1, 3}, read_light, 4, {3, 1.5, 0.75, 0}, {3, 1.5, 0.75, 2}},
    {LIGHT "spot/innerConeAngle",
     "SCALAR",
     {0, 0.8},
     read_light,
     6,
     {3, 1.5, 0.75, 0, 0.2, 0.5},
     {3, 1.5, 0.75, 0, 0.4, 0.5}},
    {LIGHT "spot/outerConeAngle", // the inner cone stays within it
     "SCALAR",
     {0.1, 0.1},
     read_light,
     6,
     {3, 1.5, 0.75, 0, 0.2, 0.5},
     {3, 1.5, 0.75, 0, 0.1, 0.1}},
    {"/nodes/0/translation", "VEC3", {0, 0, 0, 2, 4, 6}, read_node, 3, {0}, {1, 2, 3}},
};

static void assert_numbers(const lobe_scene *scene, const struct pointer_case *c,
                           const float *expected, const char *when) {
    float numbers[6];
    c->read(scene, numbers);
    for (size_t i = 0; i < c->count; i++)
        if (!(fabsf(numbers[i] - expected[i]) < 1e-6f))
            fail_msg("%s, %s: number %zu is %g instead of %g", c->pointer, when, i,
                     (double)numbers[i], (double)expected[i]);
}

static void properties_follow_their_channels(void **state) {
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lobe_scene *scene = open_pointer(*state, cases[i].pointer, cases[i].type, cases[i].values);
        assert_int_equal(((gltf_fixture *)*state)->warnings, 1); // the texture has no image
        assert_numbers(scene, &cases[i], cases[i].rest, "opened");
        pose(scene, 0, 1);
        assert_numbers(scene, &cases[i], cases[i].middle, "at 1 s");
        pose(scene, 1, 0);
        assert_numbers(scene, &cases[i], cases[i].rest, "in another animation");
        pose(scene, LOBE_ANIMATION_ALL, 1);
        if (cases[i].read != read_node) // which both animations move
            assert_numbers(scene, &cases[i], cases[i].middle, "in all");
        pose(scene, LOBE_ANIMATION_NONE, 0);
        assert_numbers(scene, &cases[i], cases[i].rest, "at rest");
        lobe_scene_destroy(&scene);
    }
}

/// KHR_texture_transform, composed from the three numbers; of which some may stay.
static void maps_move(void **state) {
    static const char *const pointers[] = {PBR "baseColorTexture" PLACE "rotation"};
    write_pointers(*state, pointers, 1, "SCALAR", (float[]){0, (float)M_PI});
    lobe_scene *scene = gltf_fixture_must_open(*state, "pointer.glb");
    float place[6];
    pose(scene, 0, 1);
    read_place(scene, place); // a right angle, with the offset and the scale at rest
    gltf_fixture_assert_near(place, (float[]){0, 4, 0.5f, -2, 0, 0}, 6, 1e-6f);
    lobe_scene_destroy(&scene);
    scene =
        open_pointer(*state, PBR "baseColorTexture" PLACE "offset", "VEC2", (float[]){0, 0, 1, 2});
    pose(scene, 0, 1);
    read_place(scene, place);
    gltf_fixture_assert_near(place, (float[]){2, 0, 0.5f, 0, 4, 1}, 6, 1e-6f);
    read_normal_place(scene, place);
    gltf_fixture_assert_near(place, (float[]){1, 0, 0, 0, 1, 0}, 6, 1e-6f);
    lobe_scene_destroy(&scene);
}

/// What a pose changes is counted; what no animation moves is the host's.
static void only_what_moves_is_written(void **state) {
    lobe_scene *scene =
        open_pointer(*state, PBR "roughnessFactor", "SCALAR", (float[]){0.25f, 0.75f});
    lobe_posed_material *posed = &scene->rig->materials[0];
    assert_int_equal(posed->material, 0);
    assert_int_equal(scene->rig->materials[1].material, -1); // not in the scene
    pose(scene, 0, 0);
    const uint32_t version = posed->version;
    scene->materials[0].metallic = 0.75f;
    scene->lights[0].intensity[0] = 17;
    pose(scene, 0, 0);
    assert_int_equal(posed->version, version);
    pose(scene, 0, 0.5);
    assert_int_equal(posed->version, version + 1);
    assert_true(scene->materials[0].metallic == 0.75f && scene->lights[0].intensity[0] == 17);
    lobe_scene_destroy(&scene);
}

/// Files of text, too; and a node that the target has nevertheless does no harm.
static void text_and_nodes_are_read(void **state) {
    static const char *const targets[] = {"", "\"node\":0,"};
    for (size_t i = 0; i < 2; i++) {
        char text[2048];
        snprintf(text, sizeof text,
                 "\xef\xbb\xbf{\"asset\":{\"version\":\"2.0\"},\"accessors\":[{\"componentType\":"
                 "5126,\"count\":3,\"type\":\"VEC3\"},{\"componentType\":5126,\"count\":1,"
                 "\"type\":\"SCALAR\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":"
                 "0},\"material\":0}]}],\"materials\":[{}],\"nodes\":[{\"mesh\":0}],"
                 "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{%s\"extensions\":{"
                 "\"KHR_animation_pointer\":{\"pointer\":\"" PBR "roughnessFactor\"}},"
                 "\"path\":\"pointer\"}},{\"sampler\":0,\"target\":{\"path\":\"translation\"}}],"
                 "\"samplers\":[{\"input\":1,\"output\":1}]}]}",
                 targets[i]);
        gltf_fixture_write_text(*state, "pointer.gltf", text);
        lobe_scene *scene = gltf_fixture_must_open(*state, "pointer.gltf");
        // The second channel, of no node, moves nothing.
        assert_int_equal(scene->rig->animations[0].channel_count, 1);
        assert_int_equal(scene->rig->animations[0].channels[0].path, LOBE_CHANNEL_ROUGHNESS);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Errors

static void broken_pointers_are_named(void **state) {
    static const struct {
        const char *pointer, *type, *cause;
    } broken[] = {
        {"/materials/2/alphaCutoff", "SCALAR", "there is no such material; the file has 2"},
        {"/materials/00/alphaCutoff", "SCALAR", "there is no such material"},
        {"/materials/-1/alphaCutoff", "SCALAR", "there is no such material"},
        {"/materials/99999999999999999999/alphaCutoff", "SCALAR", "there is no such material"},
        {"/materials/0", "SCALAR", "there is no such material"},
        {"/materials/", "SCALAR", "there is no such material"},
        {"/nodes/7/scale", "VEC3", "there is no such node; the file has 2"},
        {"/extensions/KHR_lights_punctual/lights/1/color", "VEC3", "there is no such light"},
        {"materials/0/alphaCutoff", "SCALAR", "it does not begin with '/'"},
        {"", "SCALAR", "it does not begin with '/'"},
        {"/materials/0/alphaCutoff", "VEC2", "2 components of type 5126 are no alphaCutoff"},
        {PBR "baseColorFactor", "VEC3", "3 components of type 5126 are no baseColorFactor"},
        {"/nodes/0/weights", "SCALAR", "node 0 has no morph targets"},
    };
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        write_pointers(*state, &broken[i].pointer, 1, broken[i].type, (float[8]){0});
        gltf_fixture_must_fail(*state, "pointer.glb", LOBE_ERROR_MALFORMED, broken[i].cause);
        gltf_fixture_must_fail(*state, "pointer.glb", LOBE_ERROR_MALFORMED,
                               "channel 0 of animation 'glow'");
    }
}

static void other_properties_are_left_out(void **state) {
    static const char *const pointers[] = {
        "/cameras/0/perspective/yfov", "/materials/0/doubleSided",
        "/materials/1/normalTexture/extensions/x/offset", PBR "metallicFactor"};
    gltf_fixture *fixture = *state;
    write_pointers(fixture, pointers, 4, "SCALAR", (float[]){0, 1});
    lobe_scene *scene = gltf_fixture_must_open(fixture, "pointer.glb");
    assert_non_null(strstr(fixture->warnings_text, "animations of other properties"));
    assert_int_equal(scene->rig->animations[0].channel_count, 1);
    assert_int_equal(scene->rig->animations[0].channels[0].path, LOBE_CHANNEL_METALLIC);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(properties_follow_their_channels),
        cmocka_unit_test(maps_move),
        cmocka_unit_test(only_what_moves_is_written),
        cmocka_unit_test(text_and_nodes_are_read),
        cmocka_unit_test(broken_pointers_are_named),
        cmocka_unit_test(other_properties_are_left_out),
    };
    return cmocka_run_group_tests(tests, gltf_fixture_setup, gltf_fixture_teardown);
}
