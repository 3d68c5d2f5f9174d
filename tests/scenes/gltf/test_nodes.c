// Nodes of glTF files: transforms, lights, cameras, and what is added when they are missing.

#include "tests/scenes/gltf/gltf_fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define NEAR 1e-6f

// One mesh with one triangle, after which `members` (each preceded by a comma) define the rest.
static void write_nodes(const gltf_fixture *fixture, const char *name, const char *members) {
    char json[4096];
    snprintf(json, sizeof json,
             "{\"asset\":{\"version\":\"2.0\"},\"meshes\":[{\"primitives\":[{\"attributes\":"
             "{\"POSITION\":0}}]}],\"buffers\":[{\"byteLength\":36}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{"
             "\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}]%s}",
             members);
    gltf_fixture_write_glb(fixture, name, json, gltf_fixture_triangle.data, 36);
}

static lobe_scene *open_nodes(gltf_fixture *fixture, const char *members) {
    write_nodes(fixture, "nodes.glb", members);
    return gltf_fixture_must_open(fixture, "nodes.glb");
}

static void transforms_are_composed_along_the_hierarchy(void **state) {
    // Root: a quarter turn about z (a quaternion of length 2), then up by one; child: twice as
    // large, three to the right; grandchild: a matrix with only a translation.
    lobe_scene *scene =
        open_nodes(*state, ",\"nodes\":[{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]},"
                           "{\"children\":[2],\"rotation\":[0,0,1.41421356,1.41421356],"
                           "\"translation\":[0,1,0]},"
                           "{\"children\":[0],\"scale\":[2,2,2],\"translation\":[3,0,0]}],"
                           "\"scenes\":[{\"nodes\":[]},{\"nodes\":[1]}],\"scene\":1");
    assert_int_equal(scene->instance_count, 1);
    // x -> 2y, y -> -2x, z -> 2z; the origin goes to (0, 0, 10), (3, 0, 10), (0, 4, 10).
    static const float expected[16] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 4, 10, 1};
    gltf_fixture_assert_near(scene->instances[0].transform, expected, 16, 1e-5f);
    gltf_fixture_assert_near(scene->minimum, (const float[]){-2, 4, 10}, 3, 1e-5f);
    gltf_fixture_assert_near(scene->maximum, (const float[]){0, 6, 10}, 3, 1e-5f);
    lobe_scene_destroy(&scene);
}

static void rotations_turn_the_right_way(void **state) {
    // A third of a turn about (1, 1, 1), x -> y -> z -> x, as a quaternion of length 2.
    lobe_scene *scene = open_nodes(*state, ",\"nodes\":[{\"mesh\":0,\"rotation\":[1,1,1,1]}]");
    static const float expected[16] = {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1};
    gltf_fixture_assert_near(scene->instances[0].transform, expected, 16, NEAR);
    lobe_scene_destroy(&scene);
}

static void meshes_are_shared_by_their_instances(void **state) {
    lobe_scene *scene =
        open_nodes(*state, ",\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"translation\":[1,2,3]}]");
    assert_int_equal(scene->mesh_count, 1);
    assert_int_equal(scene->material_count, 1);
    assert_int_equal(scene->instance_count, 2);
    assert_int_equal(scene->instances[0].mesh, scene->instances[1].mesh);
    lobe_scene_destroy(&scene);
}

static float triangle_normal_z(const lobe_scene *scene, const lobe_instance *instance) {
    const lobe_mesh *mesh = &scene->meshes[instance->mesh];
    const float *m = instance->transform;
    float p[3][2];
    for (int k = 0; k < 3; k++) {
        const float *v = mesh->vertices[mesh->indices[k]].position;
        p[k][0] = m[0] * v[0] + m[4] * v[1] + m[8] * v[2];
        p[k][1] = m[1] * v[0] + m[5] * v[1] + m[9] * v[2];
    }
    return (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
}

static void mirroring_keeps_fronts_in_front(void **state) {
    // Mirrored in the plane y = 0, a triangle that faces +z still faces +z.
    lobe_scene *scene =
        open_nodes(*state, ",\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"scale\":[1,-1,1]},"
                           "{\"mesh\":0,\"scale\":[-1,1,1]},{\"mesh\":0,\"scale\":[-1,-1,1]}]");
    assert_int_equal(scene->instance_count, 4);
    assert_int_equal(scene->mesh_count, 2);
    for (int i = 0; i < 4; i++) {
        const lobe_instance *instance = &scene->instances[i];
        const float *m = instance->transform;
        assert_true(triangle_normal_z(scene, instance) > 0);
        assert_true(m[0] * m[5] * m[10] > 0);
        assert_int_equal(instance->mesh, i == 1 || i == 2);
        gltf_fixture_assert_near(scene->meshes[instance->mesh].vertices[0].normal,
                                 (const float[]){0, 0, 1}, 3, NEAR);
    }
    gltf_fixture_assert_near(scene->minimum, (const float[]){-1, -1, 0}, 3, NEAR);
    gltf_fixture_assert_near(scene->maximum, (const float[]){1, 1, 0}, 3, NEAR);
    // The tangent frame is mirrored, too.
    const lobe_scene_vertex *plain = &scene->meshes[0].vertices[1];
    const lobe_scene_vertex *mirrored = &scene->meshes[1].vertices[1];
    assert_true(mirrored->position[0] == -plain->position[0]);
    assert_true(mirrored->tangent[0] == -plain->tangent[0]);
    assert_true(mirrored->tangent[1] == plain->tangent[1]);
    assert_true(mirrored->tangent[3] == -plain->tangent[3]);
    lobe_scene_destroy(&scene);
}

static void instances_scaled_to_nothing_are_left_out(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene =
        open_nodes(fixture, ",\"nodes\":[{\"mesh\":0,\"scale\":[1,0,1]},{\"mesh\":0}]");
    assert_int_equal(scene->instance_count, 1);
    assert_non_null(strstr(fixture->warnings_text, "1 instances"));
    lobe_scene_destroy(&scene);
}

static const char lights[] =
    ",\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":"
    "{\"lights\":[{\"type\":\"directional\",\"color\":[1,0.5,0.25],\"intensity\":4},"
    "{\"type\":\"point\",\"intensity\":10,\"range\":7},"
    "{\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.25}}%s]}},"
    "\"nodes\":[{\"mesh\":0},{\"rotation\":[-0.70710678,0,0,0.70710678],\"extensions\":"
    "{\"KHR_lights_punctual\":{\"light\":0}}},{\"translation\":[1,2,3],\"extensions\":"
    "{\"KHR_lights_punctual\":{\"light\":1}},\"children\":[3]},{\"translation\":[0,1,0],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}}%s]";

static void lights_are_placed_by_their_nodes(void **state) {
    gltf_fixture *fixture = *state;
    char members[2048];
    snprintf(members, sizeof members, lights, "", "");
    lobe_scene *scene = open_nodes(fixture, members);
    assert_int_equal(fixture->warnings, 0);
    assert_int_equal(fixture->notices, 1); // only the camera
    assert_int_equal(scene->light_count, 3);
    const lobe_light *sun = &scene->lights[0], *lamp = &scene->lights[1], *spot = &scene->lights[2];
    assert_int_equal(sun->type, LOBE_LIGHT_DIRECTIONAL);
    gltf_fixture_assert_near(sun->direction, (const float[]){0, -1, 0}, 3, NEAR);
    gltf_fixture_assert_near(sun->intensity, (const float[]){4, 2, 1}, 3, NEAR);
    assert_int_equal(lamp->type, LOBE_LIGHT_POINT);
    gltf_fixture_assert_near(lamp->position, (const float[]){1, 2, 3}, 3, NEAR);
    gltf_fixture_assert_near(lamp->intensity, (const float[]){10, 10, 10}, 3, NEAR);
    assert_true(lamp->range == 7);
    assert_int_equal(spot->type, LOBE_LIGHT_SPOT);
    gltf_fixture_assert_near(spot->position, (const float[]){1, 3, 3}, 3, NEAR);
    gltf_fixture_assert_near(spot->direction, (const float[]){0, 0, -1}, 3, NEAR);
    gltf_fixture_assert_near(spot->intensity, (const float[]){1, 1, 1}, 3, NEAR);
    gltf_fixture_assert_near(&spot->inner_cone, (const float[]){0.25f}, 1, NEAR);
    gltf_fixture_assert_near(&spot->outer_cone, (const float[]){(float)M_PI_4}, 1, NEAR);
    assert_true(spot->range == 0);
    lobe_scene_destroy(&scene);
}

static void bad_lights_are_refused(void **state) {
    static const char *const bad[] = {
        "{\"type\":\"laser\"}",
        "{\"type\":\"point\",\"intensity\":-1}",
        "{\"type\":\"point\",\"color\":[1,1e30,1]}",
        "{\"type\":\"spot\",\"spot\":{\"innerConeAngle\":1,\"outerConeAngle\":0.5}}",
        "{\"type\":\"spot\",\"spot\":{\"outerConeAngle\":3}}",
    };
    const char *node = ",{\"extensions\":{\"KHR_lights_punctual\":{\"light\":%d}}}";
    char members[2048], extra_light[256], extra_node[256];
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        snprintf(extra_light, sizeof extra_light, ",%s", bad[i]);
        snprintf(extra_node, sizeof extra_node, node, 3);
        snprintf(members, sizeof members, lights, extra_light, extra_node);
        write_nodes(*state, "light.glb", members);
        gltf_fixture_must_fail(*state, "light.glb", LOBE_ERROR_MALFORMED, "light 3");
    }
    snprintf(extra_node, sizeof extra_node, node, 4);
    snprintf(members, sizeof members, lights, "", extra_node);
    write_nodes(*state, "light.glb", members);
    gltf_fixture_must_fail(*state, "light.glb", LOBE_ERROR_MALFORMED, "there is no light 4");
}

static void first_camera_is_used(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_nodes(
        fixture, ",\"nodes\":[{\"mesh\":0},{\"camera\":1,\"translation\":[0,0,4],\"scale\":"
                 "[3,3,3]},{\"camera\":0}],\"cameras\":[{\"type\":\"orthographic\","
                 "\"orthographic\":{\"xmag\":1,\"ymag\":1,\"znear\":0,\"zfar\":9}},"
                 "{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.75,\"znear\":0.125}}]");
    assert_true(scene->has_camera);
    assert_int_equal(fixture->notices, 1); // only the sky
    const lobe_camera *camera = &scene->camera;
    gltf_fixture_assert_near(camera->eye, (const float[]){0, 0, 4}, 3, NEAR);
    gltf_fixture_assert_near(camera->target, (const float[]){0, 0, 0}, 3, NEAR);
    gltf_fixture_assert_near(camera->up, (const float[]){0, 1, 0}, 3, NEAR);
    assert_true(camera->vertical_field_of_view == 0.75f && camera->near_plane == 0.125f);
    assert_true(camera->orthographic_height == 0);
    lobe_scene_destroy(&scene);
}

static void orthographic_cameras_give_their_height(void **state) {
    lobe_scene *scene =
        open_nodes(*state, ",\"nodes\":[{\"mesh\":0},{\"camera\":0,\"rotation\":[0,0.70710678,0,"
                           "0.70710678]}],\"cameras\":[{\"type\":\"orthographic\",\"orthographic\":"
                           "{\"xmag\":4,\"ymag\":3,\"znear\":0,\"zfar\":9}}]");
    const lobe_camera *camera = &scene->camera;
    assert_true(camera->vertical_field_of_view == 0 && camera->orthographic_height == 6);
    assert_true(camera->near_plane > 0);
    // Everything is behind or beside the camera: it keeps looking along -x, at a distance of half
    // the scene's diagonal.
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += pow(0.5 * ((double)scene->maximum[i] - scene->minimum[i]), 2);
    gltf_fixture_assert_near(camera->target, (const float[]){-(float)sqrt(square), 0, 0}, 3, NEAR);
    lobe_scene_destroy(&scene);
}

/// A near plane at the eye is moved away from it, by little compared with what the picture shows.
static void orthographic_near_planes_have_no_length_of_their_own(void **state) {
    static const char *const heights[] = {"3e-7", "3", "3e7"};
    for (size_t i = 0; i < 3; i++) {
        char members[512];
        snprintf(members, sizeof members,
                 ",\"nodes\":[{\"mesh\":0},{\"camera\":0}],\"cameras\":[{\"type\":\"orthographic\","
                 "\"orthographic\":{\"xmag\":1,\"ymag\":%s,\"znear\":0,\"zfar\":9}}]",
                 heights[i]);
        lobe_scene *scene = open_nodes(*state, members);
        const lobe_camera *camera = &scene->camera;
        assert_true(camera->near_plane > 0);
        assert_true(camera->near_plane <= 1e-3f * camera->orthographic_height);
        lobe_scene_destroy(&scene);
    }
}

static void bad_cameras_are_refused(void **state) {
    static const char *const bad[] = {
        "{\"type\":\"perspective\",\"perspective\":{\"yfov\":0,\"znear\":0.1}}",
        "{\"type\":\"perspective\",\"perspective\":{\"yfov\":4,\"znear\":0.1}}",
        "{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0}}",
        "{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":-1}}",
        ("{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":1,\"ymag\":0,\"znear\":0,"
         "\"zfar\":9}}"),
    };
    char members[512];
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        snprintf(members, sizeof members, ",\"nodes\":[{\"camera\":0}],\"cameras\":[%s]", bad[i]);
        write_nodes(*state, "camera.glb", members);
        gltf_fixture_must_fail(*state, "camera.glb", LOBE_ERROR_MALFORMED, "camera 0");
    }
}

static void camera_and_sky_are_added_and_said(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_nodes(fixture, ",\"nodes\":[{\"mesh\":0,\"scale\":[5,5,5]}]");
    assert_int_equal(fixture->notices, 2);
    assert_int_equal(fixture->warnings, 0);
    assert_false(scene->has_camera);
    assert_int_equal(scene->light_count, 0);
    assert_string_equal(scene->environment->name, "sky");
    assert_false(scene->environment_visible);
    lobe_camera framing;
    lobe_scene_frame(scene, 16.0 / 9, &framing);
    assert_memory_equal(&scene->camera, &framing, sizeof framing);
    lobe_scene_destroy(&scene);
}

static void an_empty_scene_is_given_nothing(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_nodes(fixture, ",\"nodes\":[{}]");
    assert_int_equal(scene->instance_count, 0);
    assert_int_equal(scene->light_count, 0);
    assert_int_equal(fixture->notices + fixture->warnings, 0);
    lobe_scene_destroy(&scene);
}

static void bad_hierarchies_are_refused(void **state) {
    static const struct {
        const char *members, *cause;
        lobe_result result;
    } cases[] = {
        {",\"nodes\":[{\"children\":[0]}]", "its own ancestor", LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{\"children\":[1]},{\"children\":[2]},{\"children\":[1]}]", "two parents",
         LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{},{\"children\":[2]},{\"children\":[1]}]", "its own ancestor",
         LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{\"children\":[1]},{}],\"scenes\":[{\"nodes\":[0,1]}]", "is no root",
         LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{}],\"scenes\":[{\"nodes\":[0,0]}]", "in the scene twice",
         LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{\"children\":[4]}]", "there is no child node 4", LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{}],\"scenes\":[{\"nodes\":[8]}]", "there is no node 8",
         LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{}],\"scenes\":[{}],\"scene\":1", "there is no scene 1",
         LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{\"mesh\":1}]", "there is no mesh 1", LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{\"rotation\":[0,0,0,0]}]", "rotation has no length", LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{\"matrix\":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}]", "not affine",
         LOBE_ERROR_MALFORMED},
        {",\"nodes\":[{\"scale\":[1e200,1,1],\"children\":[1]},{\"scale\":[1e200,1,1]}]",
         "out of range", LOBE_ERROR_LIMIT},
        {",\"nodes\":[{\"mesh\":0,\"scale\":[9e17,9e17,9e17],\"translation\":[9e17,9e17,0]}]",
         "farther than", LOBE_ERROR_LIMIT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_nodes(*state, "bad.glb", cases[i].members);
        gltf_fixture_must_fail(*state, "bad.glb", cases[i].result, cases[i].cause);
    }
}

static void long_chains_of_nodes_are_walked_without_recursion(void **state) {
    enum { DEPTH = 100000 };
    static char members[64 + DEPTH * 24];
    size_t length = (size_t)sprintf(members, ",\"nodes\":[{\"mesh\":0}");
    for (int i = 1; i < DEPTH; i++)
        length += (size_t)sprintf(members + length, ",{\"children\":[%d]}", i - 1);
    sprintf(members + length, "]");
    static char json[sizeof members + 512];
    snprintf(json, sizeof json,
             "{\"asset\":{\"version\":\"2.0\"},\"meshes\":[{\"primitives\":[{\"attributes\":"
             "{\"POSITION\":0}}]}],\"buffers\":[{\"byteLength\":36}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{"
             "\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}]%s}",
             members);
    gltf_fixture_write_glb(*state, "chain.glb", json, gltf_fixture_triangle.data, 36);
    lobe_scene *scene = gltf_fixture_must_open(*state, "chain.glb");
    assert_int_equal(scene->instance_count, 1);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(transforms_are_composed_along_the_hierarchy),
        cmocka_unit_test(rotations_turn_the_right_way),
        cmocka_unit_test(meshes_are_shared_by_their_instances),
        cmocka_unit_test(mirroring_keeps_fronts_in_front),
        cmocka_unit_test(instances_scaled_to_nothing_are_left_out),
        cmocka_unit_test(lights_are_placed_by_their_nodes),
        cmocka_unit_test(bad_lights_are_refused),
        cmocka_unit_test(first_camera_is_used),
        cmocka_unit_test(orthographic_cameras_give_their_height),
        cmocka_unit_test(orthographic_near_planes_have_no_length_of_their_own),
        cmocka_unit_test(bad_cameras_are_refused),
        cmocka_unit_test(camera_and_sky_are_added_and_said),
        cmocka_unit_test(an_empty_scene_is_given_nothing),
        cmocka_unit_test(bad_hierarchies_are_refused),
        cmocka_unit_test(long_chains_of_nodes_are_walked_without_recursion),
    };
    return cmocka_run_group_tests_name("glTF nodes", tests, gltf_fixture_setup,
                                       gltf_fixture_teardown);
}
