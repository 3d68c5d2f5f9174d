// What shows the maps of a folder, and under which light.

#include "tests/scenes/material/folder_fixture.h"

#include <math.h>
#include <string.h>

#include "scenes/mesh/vector.h"

static void carriers_repeat_the_maps(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "albedo.png", 2, 2, 1, 2, 3);
    must_open_folder(fixture, LOBE_CARRIER_PLANE);
    const lobe_mesh *plane = &fixture->scene->meshes[0];
    assert_int_equal(plane->index_count, 6);
    assert_true(plane->vertices[3].texture_coordinates[0][0] -
                    plane->vertices[0].texture_coordinates[0][0] ==
                4);
    must_open_folder(fixture, LOBE_CARRIER_SPHERE);
    const lobe_mesh *sphere = &fixture->scene->meshes[0];
    assert_int_equal(sphere->index_count, 6 * 63 * 128);
    assert_true(sphere->vertices[sphere->vertex_count - 1].texture_coordinates[0][0] == 4);
}

// Texels of a map of that extent across a pixel of 1280 x 720, at the middle of the three corners.
static double texels_across(const lobe_camera *camera, const lobe_mesh *mesh, size_t first,
                            double extent, bool *inside) {
    vector3 eye = vector3_load(camera->eye);
    vector3 forward = vector3_subtract(vector3_load(camera->target), eye);
    vector3_normalise(&forward, 0);
    vector3 right = vector3_cross(forward, vector3_load(camera->up));
    vector3_normalise(&right, 0);
    vector3 up = vector3_cross(right, forward);
    double scale = 360 / tan(camera->vertical_field_of_view / 2), at[3][2], uv[3][2];
    for (int k = 0; k < 3; k++) {
        const lobe_scene_vertex *vertex = &mesh->vertices[mesh->indices[first + k]];
        vector3 p = vector3_subtract(vector3_load(vertex->position), eye);
        double depth = vector3_dot(p, forward);
        at[k][0] = scale * vector3_dot(p, right) / depth;
        at[k][1] = scale * vector3_dot(p, up) / depth;
        *inside = depth > 0 && fabs(at[k][0]) < 640 && fabs(at[k][1]) < 360;
        uv[k][0] = vertex->texture_coordinates[0][0], uv[k][1] = vertex->texture_coordinates[0][1];
    }
    double pixels = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                    (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
    double texels = (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) -
                    (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]);
    return extent * sqrt(fabs(texels / pixels));
}

static void cloth_is_seen_with_two_to_eight_texels_a_pixel(void **state) {
    folder_fixture *fixture = *state;
    const uint32_t extents[] = {128, 512};
    for (int i = 0; i < 2; i++) {
        write_map(fixture, "albedo.png", extents[i], 16, 1, 2, 3);
        const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_CLOTH);
        assert_true(material->double_sided);
        const lobe_mesh *cloth = &fixture->scene->meshes[0];
        size_t seen = 0, fitting = 0;
        for (size_t k = 0; k < cloth->index_count; k += 3) {
            bool inside;
            double across = texels_across(&fixture->scene->camera, cloth, k, extents[i], &inside);
            seen += inside;
            fitting += inside && across > 2 && across < 8;
        }
        assert_true(seen > cloth->index_count / 3 / 2);
        assert_true(fitting > seen * 95 / 100);
    }
}

static double distance(const lobe_scene_vertex *a, const lobe_scene_vertex *b) {
    return vector3_length(vector3_subtract(vector3_load(a->position), vector3_load(b->position)));
}

// It waves, but hardly stretches: edges are as long as the maps on them.
static void cloth_keeps_its_lengths(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "albedo.png", 400, 16, 1, 2, 3);
    must_open_folder(fixture, LOBE_CARRIER_CLOTH);
    const lobe_mesh *cloth = &fixture->scene->meshes[0];
    const double tile = 400 * 0.0005;
    for (size_t i = 0; i < cloth->index_count; i++) {
        const lobe_scene_vertex *a = &cloth->vertices[cloth->indices[i]];
        const lobe_scene_vertex *b = &cloth->vertices[cloth->indices[i - i % 3 + (i + 1) % 3]];
        double u = b->texture_coordinates[0][0] - a->texture_coordinates[0][0];
        double v = b->texture_coordinates[0][1] - a->texture_coordinates[0][1];
        double ratio = distance(a, b) / (tile * sqrt(u * u + v * v));
        assert_true(ratio > 0.99 && ratio < 1.15);
    }
    assert_true(cloth->maximum[2] - cloth->minimum[2] > 0.04f);
}

static void the_sky_lights_what_has_no_light(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "metallic.png", 2, 2, 255, 255, 255);
    must_open_folder(fixture, LOBE_CARRIER_SPHERE);
    assert_true(fixture->scene->has_added_light && fixture->scene->light_count == 0);
    assert_string_equal(fixture->scene->environment->name, "sky");
    // A host that brings light of its own gets none, and no notice of it.
    const lobe_carrier carrier = LOBE_CARRIER_SPHERE;
    const lobe_scene_open_parameters parameters = {
        .scene = fixture->path, .own_light_only = true, .carrier = &carrier};
    lobe_scene_destroy(&fixture->scene);
    log_recorder_start(&fixture->recorder);
    assert_int_equal(lobe_scene_open_with(&parameters, &fixture->recorder.host, &fixture->scene),
                     LOBE_OK);
    assert_null(fixture->scene->environment);
    assert_false(fixture->scene->has_added_light);
    assert_null(strstr(fixture->recorder.all_notices, "added"));
}

#define FOLDER_TEST(name)                                                                          \
    cmocka_unit_test_setup_teardown(name, folder_fixture_create, folder_fixture_destroy)

int main(void) {
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(carriers_repeat_the_maps),
        FOLDER_TEST(cloth_is_seen_with_two_to_eight_texels_a_pixel),
        FOLDER_TEST(cloth_keeps_its_lengths),
        FOLDER_TEST(the_sky_lights_what_has_no_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
