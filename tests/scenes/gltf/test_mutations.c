// A few hundred damaged copies of small valid files, from a fixed seed. Each copy opens or fails
// with one message; the sanitizers check the rest.

#include "tests/scenes/gltf/gltf_builder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MUTATIONS 400

typedef struct file_content {
    size_t size;
    uint8_t bytes[8192];
} file_content;

static uint32_t next_random(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static file_content read_file(gltf_fixture *fixture, const char *name) {
    file_content file = {0};
    FILE *stream = fopen(gltf_fixture_path(fixture, name), "rb");
    assert_non_null(stream);
    file.size = fread(file.bytes, 1, sizeof file.bytes, stream);
    fclose(stream);
    assert_true(file.size > 0 && file.size < sizeof file.bytes);
    return file;
}

// A file with a little of everything.
static file_content make_file(gltf_fixture *fixture) {
    static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const float coordinates[] = {0, 0, 1, 0, 0, 1};
    static const uint8_t colours[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    static const uint16_t indices[] = {0, 1, 2};
    const gltf_fixture_accessor accessors[] = {
        gltf_fixture_triangle,
        {"NORMAL", GLTF_FLOAT, "VEC3", false, 3, normals, sizeof normals},
        {"TEXCOORD_0", GLTF_FLOAT, "VEC2", false, 3, coordinates, sizeof coordinates},
        {"COLOR_0", GLTF_UNSIGNED_BYTE, "VEC4", true, 3, colours, sizeof colours},
        {NULL, GLTF_UNSIGNED_SHORT, "SCALAR", false, 3, indices, sizeof indices}};
    const gltf_fixture_mesh mesh = {
        .accessors = accessors,
        .accessor_count = 5,
        .primitive = ",\"material\":0",
        .node = ",\"children\":[1],\"rotation\":[0,0,0,1]},{\"camera\":0,\"extensions\":{"
                "\"KHR_lights_punctual\":{\"light\":0}},\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,"
                "0,0,1]",
        .root = ",\"materials\":[{\"normalTexture\":{\"index\":0,\"extensions\":{"
                "\"KHR_texture_transform\":{\"offset\":[0,0.5],\"rotation\":1}}}}],"
                "\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{\"wrapS\":33071}],"
                "\"images\":[{\"uri\":\"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAAB"
                "CAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==\"}],"
                "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,"
                "\"znear\":0.1}}],\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{"
                "\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"spot\":{}}]}}"};
    gltf_fixture_write_mesh(fixture, "whole.glb", &mesh);
    lobe_scene *scene = gltf_fixture_must_open(fixture, "whole.glb");
    assert_int_equal(scene->image_count, 1);
    assert_int_equal(scene->light_count, 1);
    assert_true(scene->has_camera);
    lobe_scene_destroy(&scene);
    return read_file(fixture, "whole.glb");
}

// A file with a skin, morph targets and one animation of everything.
static file_content make_moving_file(gltf_fixture *fixture) {
    static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const float weights[] = {1, 0, 0, 0, .5f, .5f, 0, 0, 0, 1, 0, 0};
    static const uint8_t joints[] = {0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    static const float matrices[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                       1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    gltf_builder builder = {0};
    gltf_builder_add_floats(&builder, "VEC3", 3, positions);
    gltf_builder_add(&builder, GLTF_UNSIGNED_BYTE, "VEC4", false, 3, joints, sizeof joints);
    gltf_builder_add_floats(&builder, "VEC4", 3, weights);
    gltf_builder_add_floats(&builder, "MAT4", 2, matrices);
    gltf_builder_add_floats(&builder, "SCALAR", 2, (float[]){0, 1});
    gltf_builder_add_floats(&builder, "VEC4", 2, (float[]){0, 0, 0, 1, 1, 0, 0, 0});
    gltf_builder_add_floats(&builder, "SCALAR", 6, (float[]){0, 1, 0, 2, 0, 1});
    gltf_builder_write(
        &builder, fixture, "moving.glb",
        ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":1,"
        "\"WEIGHTS_0\":2},\"targets\":[{\"POSITION\":0,\"NORMAL\":0}]}],\"weights\":[0.5]}],"
        "\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":3}],\"nodes\":[{\"mesh\":0,"
        "\"skin\":0},{\"children\":[2],\"scale\":[1,2,1]},{\"translation\":[0,1,0]},{\"mesh\":0}],"
        "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":"
        "\"rotation\"}},{\"sampler\":1,\"target\":{\"node\":0,\"path\":\"weights\"}}],"
        "\"samplers\":[{\"input\":4,\"output\":5},{\"input\":4,\"output\":6,\"interpolation\":"
        "\"CUBICSPLINE\"}]}]");
    lobe_scene *scene = gltf_fixture_must_open(fixture, "moving.glb");
    assert_int_equal(scene->rig->animations[0].channel_count, 2);
    lobe_scene_destroy(&scene);
    return read_file(fixture, "moving.glb");
}

static void overwrite_byte(file_content *file, uint32_t *seed) {
    file->bytes[next_random(seed) % file->size] = (uint8_t)next_random(seed);
}

static void flip_bit(file_content *file, uint32_t *seed) {
    file->bytes[next_random(seed) % file->size] ^= (uint8_t)(1 << next_random(seed) % 8);
}

// Changes a digit of the text: indices, counts and sizes that are wrong but well-formed.
static void change_digit(file_content *file, uint32_t *seed) {
    size_t at = next_random(seed) % file->size;
    for (size_t i = 0; i < file->size; i++) {
        uint8_t *byte = &file->bytes[(at + i) % file->size];
        if (*byte < '0' || *byte > '9')
            continue;
        *byte = (uint8_t)('0' + next_random(seed) % 10);
        return;
    }
}

// Copies one piece over another, which moves values to the wrong names.
static void move_piece(file_content *file, uint32_t *seed) {
    size_t length = 1 + next_random(seed) % 16;
    size_t from = next_random(seed) % (file->size - length);
    size_t to = next_random(seed) % (file->size - length);
    memmove(file->bytes + to, file->bytes + from, length);
}

static void (*const mutators[])(file_content *file, uint32_t *seed) = {
    overwrite_byte, flip_bit, change_digit, change_digit, change_digit, move_piece};

// Poses stay finite, or fail.
static void play(lobe_scene *scene) {
    for (double seconds = -1; seconds < 3; seconds += 0.375)
        if (scene->rig && scene->rig->animation_count > 0 &&
            lobe_scene_set_pose(scene, &(lobe_pose){.seconds = seconds}, NULL) == LOBE_OK)
            for (int axis = 0; axis < 3; axis++)
                assert_true(isfinite(scene->minimum[axis]) && isfinite(scene->maximum[axis]));
}

static void damage(gltf_fixture *fixture, const file_content *whole) {
    uint32_t seed = 2017;
    size_t opened = 0, failed = 0;
    for (int i = 0; i < MUTATIONS; i++) {
        file_content copy = *whole;
        uint32_t count = 1 + next_random(&seed) % 3;
        for (uint32_t k = 0; k < count; k++)
            mutators[next_random(&seed) % (sizeof mutators / sizeof *mutators)](&copy, &seed);
        lobe_scene *scene;
        gltf_fixture_write(fixture, "damaged.glb", copy.bytes, copy.size);
        if (gltf_fixture_open(fixture, "damaged.glb", &scene) == LOBE_OK) {
            opened++;
            play(scene);
        } else {
            failed++;
        }
        lobe_scene_destroy(&scene);
    }
    // Both outcomes occur; otherwise the damage is too small or too large to find anything.
    assert_true(opened > MUTATIONS / 20);
    assert_true(failed > MUTATIONS / 20);
}

static void damaged_files_are_survived(void **state) {
    const file_content whole = make_file(*state);
    damage(*state, &whole);
}

static void damaged_animations_are_survived(void **state) {
    const file_content whole = make_moving_file(*state);
    damage(*state, &whole);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_files_are_survived),
        cmocka_unit_test(damaged_animations_are_survived),
    };
    return cmocka_run_group_tests_name("damaged glTF files", tests, gltf_fixture_setup,
                                       gltf_fixture_teardown);
}
