// Real models and collected broken files. They are stored beside the project; without them these
// tests are skipped.

#include "tests/scenes/gltf/gltf_fixture.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "scenes/mesh/mesh.h"

#define MODELS LOBE_TEST_ASSETS "/models/"
#define BROKEN LOBE_TEST_ASSETS "/bad/gltf"

static void skip_without(const char *path) {
    if (access(path, R_OK) != 0)
        skip();
}

static lobe_scene *must_open(gltf_fixture *fixture, const char *path) {
    lobe_scene *scene;
    lobe_result result = gltf_fixture_open_path(fixture, path, &scene);
    if (result != LOBE_OK)
        fail_msg("%s: %s", lobe_result_name(result), fixture->error);
    return scene;
}

static void models_have_the_counts_of_their_files(void **state) {
    // Counted in the text of the files: triangle primitives, their vertices, indices, materials and
    // images in use (the image with a transform is used both as colour and as data), and warnings:
    // FlightHelmet blends its lenses, the vertex colours come with points and lines.
    static const struct {
        const char *path;
        size_t meshes, vertices, indices, materials, images, warnings;
    } models[] = {
        {"01_textured_sphere/01_textured_sphere.gltf", 1, 561, 2880, 1, 3, 0},
        {"09_texture_transform/09_texture_transform.gltf", 1, 4, 6, 1, 2, 0},
        {"12_orm_two_uvmaps/12_orm_two_uvmaps.gltf", 1, 24, 36, 1, 1, 0},
        {"22_vertex_color/22_vertex_color.gltf", 3, 13, 15, 1, 0, 1},
        {"FlightHelmet/FlightHelmet.gltf", 6, 55392, 284166, 6, 15, 1},
        {"polyhaven_1k/tea_set_01_1k.gltf", 10, 21875, 120888, 1, 3, 0},
    };
    skip_without(MODELS);
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        char path[512];
        snprintf(path, sizeof path, MODELS "%s", models[i].path);
        gltf_fixture *fixture = *state;
        lobe_scene *scene = must_open(fixture, path);
        size_t vertices = 0, indices = 0;
        for (size_t m = 0; m < scene->mesh_count; m++) {
            vertices += scene->meshes[m].vertex_count;
            indices += scene->meshes[m].index_count;
        }
        assert_int_equal(scene->mesh_count, models[i].meshes);
        assert_int_equal(scene->instance_count, models[i].meshes);
        assert_int_equal(vertices, models[i].vertices);
        assert_int_equal(indices, models[i].indices);
        assert_int_equal(scene->material_count, models[i].materials);
        assert_int_equal(scene->image_count, models[i].images);
        assert_int_equal(fixture->warnings, models[i].warnings);
        lobe_scene_destroy(&scene);
    }
}

static void maps_use_their_own_set_of_coordinates(void **state) {
    skip_without(MODELS);
    lobe_scene *scene = must_open(*state, MODELS "12_orm_two_uvmaps/12_orm_two_uvmaps.gltf");
    const lobe_mesh *mesh = &scene->meshes[0];
    const lobe_material *material = &scene->materials[0];
    assert_true(mesh->has_texture_coordinates[0] && mesh->has_texture_coordinates[1]);
    assert_int_equal(material->occlusion_map.texture_coordinates, 1);
    // All of its texels are (47, 164, 48); the same image is the map of roughness and metal.
    assert_int_equal(material->occlusion_map.image, 0);
    assert_int_equal(material->metallic_roughness_map.image, -1);
    assert_float_equal(material->roughness, 164 / 255.0, 1e-6);
    assert_float_equal(material->metallic, 48 / 255.0, 1e-6);
    lobe_scene_destroy(&scene);
}

// The files' tangents were made by their authors' tools; ours must agree, above all in handedness.
static void computed_tangents_agree_with_those_of_the_files(void **state) {
    static const char *const paths[] = {MODELS "01_textured_sphere/01_textured_sphere.gltf",
                                        MODELS "FlightHelmet/FlightHelmet.gltf"};
    skip_without(MODELS);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        lobe_scene *scene = must_open(*state, paths[i]);
        size_t vertices = 0, same_hand = 0;
        double cosines = 0;
        for (size_t m = 0; m < scene->mesh_count; m++) {
            lobe_mesh *mesh = &scene->meshes[m];
            size_t count = mesh->vertex_count;
            float(*given)[4] = malloc(count * sizeof *given);
            for (size_t v = 0; v < count; v++)
                memcpy(given[v], mesh->vertices[v].tangent, sizeof *given);
            assert_int_equal(scenes_mesh_compute_tangents(mesh, NULL, NULL), LOBE_OK);
            for (size_t v = 0; v < count; v++) {
                const float *t = mesh->vertices[v].tangent;
                // At the poles of the sphere all coordinates are equal, so any tangent is right.
                if (fabsf(mesh->vertices[v].normal[1]) > 0.97f)
                    continue;
                vertices++;
                same_hand += t[3] == given[v][3];
                cosines += t[0] * given[v][0] + t[1] * given[v][1] + t[2] * given[v][2];
            }
            free(given);
        }
        if (same_hand < 0.99 * (double)vertices || cosines < 0.99 * (double)vertices)
            fail_msg("%s: %zu of %zu of the same hand, mean cosine %g", paths[i], same_hand,
                     vertices, cosines / (double)vertices);
        lobe_scene_destroy(&scene);
    }
}

static bool has_suffix(const char *name, const char *suffix) {
    size_t length = strlen(name), end = strlen(suffix);
    return length >= end && strcmp(name + length - end, suffix) == 0;
}

// gltf_fixture_open_path asserts a scene, or one message that names the file.
static void open_all(gltf_fixture *fixture, const char *folder, size_t *opened, size_t *failed) {
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_type == DT_DIR && entry->d_name[0] != '.')
            open_all(fixture, path, opened, failed);
        if (!has_suffix(path, ".gltf") && !has_suffix(path, ".glb"))
            continue;
        lobe_scene *scene;
        if (gltf_fixture_open_path(fixture, path, &scene) == LOBE_OK)
            ++*opened;
        else
            ++*failed;
        lobe_scene_destroy(&scene);
    }
    closedir(directory);
}

static void every_broken_file_is_survived(void **state) {
    size_t opened = 0, failed = 0;
    skip_without(BROKEN);
    open_all(*state, BROKEN, &opened, &failed);
    assert_true(opened > 30); // many are valid, or wrong where lobe does not look
    assert_true(failed > 50);
}

static void broken_files_fail_for_the_right_reason(void **state) {
    static const struct {
        const char *path;
        lobe_result result;
        const char *cause;
    } cases[] = {
        {"assimp/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", LOBE_ERROR_MALFORMED,
         "not finite"},
        {"assimp/IndexOutOfRange/IndexOutOfRange.gltf", LOBE_ERROR_MALFORMED, "index 0 is 255"},
        {"assimp/MissingBin/BoxTextured.gltf", LOBE_ERROR_NOT_FOUND, "BoxTextured0.bin"},
        {"assimp/RecursiveNodes/RecursiveNodes.gltf", LOBE_ERROR_MALFORMED, "ancestor"},
        {"assimp/SchemaFailures/sceneWrongType.gltf", LOBE_ERROR_MALFORMED, "scene: an integer"},
        {"assimp/wrongTypes/badNumber.gltf", LOBE_ERROR_MALFORMED, "a number expected"},
        {"tinygltf/BoundsChecking/integer-out-of-bounds.gltf", LOBE_ERROR_MALFORMED,
         "bufferViews[0].byteLength"},
        {"unsupported/BoxTextured_meshopt.glb", LOBE_ERROR_UNSUPPORTED, "EXT_meshopt_compression"},
        {"unsupported/DracoSparseMesh.gltf", LOBE_ERROR_UNSUPPORTED, "KHR_draco_mesh_compression"},
        {"validator/base/asset/1_0_version.gltf", LOBE_ERROR_UNSUPPORTED, "version 1.0"},
        {"validator/base/glb/chunk_too_big.glb", LOBE_ERROR_MALFORMED, "chunk"},
        {"validator/base/glb/invalid_version.glb", LOBE_ERROR_UNSUPPORTED, "GLB version"},
        {"validator/base/json/empty_file.gltf", LOBE_ERROR_MALFORMED, "is empty"},
        {"validator/base/node/node_loop.gltf", LOBE_ERROR_MALFORMED, "ancestor"},
        {"validator/base/node/unresolved_child_node.gltf", LOBE_ERROR_MALFORMED, "child node 1"},
    };
    skip_without(BROKEN);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        gltf_fixture *fixture = *state;
        lobe_scene *scene;
        char path[512];
        snprintf(path, sizeof path, BROKEN "/%s", cases[i].path);
        lobe_result result = gltf_fixture_open_path(fixture, path, &scene);
        lobe_scene_destroy(&scene);
        if (result != cases[i].result || !strstr(fixture->error, cases[i].cause))
            fail_msg("%s: %s", lobe_result_name(result), fixture->error);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_have_the_counts_of_their_files),
        cmocka_unit_test(maps_use_their_own_set_of_coordinates),
        cmocka_unit_test(computed_tangents_agree_with_those_of_the_files),
        cmocka_unit_test(every_broken_file_is_survived),
        cmocka_unit_test(broken_files_fail_for_the_right_reason),
    };
    return cmocka_run_group_tests_name("real glTF files", tests, gltf_fixture_setup,
                                       gltf_fixture_teardown);
}
