// Why a camera sees nothing.

#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <string.h>

#include "tools/render/empty_picture.h"

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// One triangle around the origin that faces +Z.
typedef struct triangle_scene {
    lobe_scene_vertex vertices[3];
    uint32_t indices[3];
    lobe_mesh mesh;
    lobe_material material;
    lobe_instance instance;
    lobe_scene scene;
} triangle_scene;

static void make_triangle(triangle_scene *made) {
    static const float corners[3][2] = {{-1, -1}, {1, -1}, {0, 1}};
    *made = (triangle_scene){.indices = {0, 1, 2}};
    for (int i = 0; i < 3; i++)
        memcpy(made->vertices[i].position, corners[i], sizeof corners[i]);
    made->mesh = (lobe_mesh){
        .vertices = made->vertices, .vertex_count = 3, .indices = made->indices, .index_count = 3};
    memcpy(made->instance.transform, identity, sizeof identity);
    made->scene = (lobe_scene){
        .meshes = &made->mesh,
        .mesh_count = 1,
        .materials = &made->material,
        .material_count = 1,
        .instances = &made->instance,
        .instance_count = 1,
        .minimum = {-1, -1, 0},
        .maximum = {1, 1, 0},
        .camera = {
            .eye = {0, 0, 5}, .up = {0, 1, 0}, .vertical_field_of_view = 0.7f, .near_plane = 0.1f}};
}

static void check(const triangle_scene *made, const char *words) {
    char text[256];
    empty_picture_explain(&made->scene, 1.5, text, sizeof text);
    if (!strstr(text, words))
        fail_msg("'%s' says nothing of '%s'", text, words);
    assert_true(strlen(text) < sizeof text - 1);
}

static void reasons_are_told(void **state) {
    (void)state;
    triangle_scene made;
    make_triangle(&made);
    check(&made, "alpha mask");
    made.scene.camera.target[2] = 9;
    check(&made, "looks away from the scene, whose middle is at 0,0,0");
    make_triangle(&made);
    made.scene.camera.target[0] = 9;
    check(&made, "looks past the scene");
    make_triangle(&made);
    made.scene.camera.near_plane = 6;
    check(&made, "near plane, 6 m");
    make_triangle(&made);
    made.scene.camera.eye[2] = -5;
    check(&made, "backs of single-sided faces");
    made.material.double_sided = true;
    check(&made, "alpha mask");
}

static void orthographic_cameras_are_understood(void **state) {
    (void)state;
    triangle_scene made;
    make_triangle(&made);
    made.scene.camera.vertical_field_of_view = 0;
    made.scene.camera.orthographic_height = 1;
    check(&made, "alpha mask");
    made.scene.camera.eye[2] = -5;
    check(&made, "backs of single-sided faces");
    made.scene.camera.eye[0] = made.scene.camera.target[0] = 4;
    check(&made, "looks past the scene");
}

static void a_turned_instance_shows_its_back(void **state) {
    (void)state;
    triangle_scene made;
    make_triangle(&made);
    made.instance.transform[0] = made.instance.transform[10] = -1; // half a turn about Y
    check(&made, "backs of single-sided faces");
}

static void one_covered_pixel_is_enough(void **state) {
    (void)state;
    float texels[2 * 4] = {1, 1, 1, 0, 1, 1, 1, 0};
    const lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 2, 1, texels};
    assert_true(empty_picture_recognise(&image));
    texels[7] = 0.01f;
    assert_false(empty_picture_recognise(&image));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reasons_are_told),
        cmocka_unit_test(orthographic_cameras_are_understood),
        cmocka_unit_test(a_turned_instance_shows_its_back),
        cmocka_unit_test(one_covered_pixel_is_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
