// Maps that lie alike though one is read by the second set of texture coordinates, since both sets
// of the meshes are equal: pictures are those of one set, as long as they are.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include "passes/upload/scene_upload.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 32, WIDTH = 16 };

/// The filter, and a pass that it only has where colours lie on normals or heights.
static const char *const methods[][2] = {
    {"toksvig", "colour_normals"}, {"moments", "colour_normals"}, {"displaced", "facet_colours"}};
enum { METHODS = sizeof methods / sizeof *methods };

/// The mesh gets a second set, `scale` times the first.
static void add_second_set(lobe_mesh *mesh, float scale) {
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 2; axis++)
            mesh->vertices[i].texture_coordinates[1][axis] =
                scale * mesh->vertices[i].texture_coordinates[0][axis];
    mesh->has_texture_coordinates[1] = true;
}

/// Colours are the normals, as they are stored.
static lobe_material coloured_bumps(lobe_scene *scene) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 10);
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 1, 17),
               colours = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    memcpy(colours.texels, normals.texels, (size_t)16 * EXTENT * EXTENT);
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 1;
    material.normal_map = scene_add_map(scene, normals);
    material.base_colour_map = scene_add_map(scene, colours);
    material.height_map = scene_add_map(scene, random_map(EXTENT, EXTENT, 0, 1, 18));
    material.height_scale = 0.01f;
    return material;
}

/// Under a sun at the side. `set`: that the colours are read by; `scale`: see add_second_set.
static lobe_scene *plane(uint32_t set, float scale) {
    lobe_scene *scene = scene_begin();
    lobe_material material = coloured_bumps(scene);
    material.base_colour_map.texture_coordinates = set;
    scene_add_square(scene, &material, 8, NULL);
    add_second_set(&scene->meshes[0], scale);
    scene_add_sun(scene, (double[]){1, 1, 0.3}, 2);
    scene_look_down(scene, 1);
    scene_end(scene);
    return scene;
}

/// Passes whose output is kept from a frame before count, too.
static bool has_pass(const lobe_graph *graph, const char *name) {
    return count_passes(graph, name, LOBE_PASS_RUN) + count_passes(graph, name, LOBE_PASS_SKIPPED) >
           0;
}

/// Draws the scene that the renderer has, and checks whether colours lie on normals.
static uint64_t picture(fixture *f, const char *const method[2], bool lies_alike) {
    const picture_request request = {.filter = method[0], .width = WIDTH, .height = WIDTH};
    lobe_frame frame = draw(f, &request);
    const uint64_t hash = image_hash(&frame.radiance);
    assert_true(has_pass(lobe_renderer_graph(f->renderer), method[1]) == lies_alike);
    lobe_frame_free(&frame);
    return hash;
}

static uint64_t new_picture(fixture *f, const lobe_scene *scene, const char *const method[2],
                            bool lies_alike) {
    hold_scene(f, scene);
    const uint64_t hash = picture(f, method, lies_alike);
    hold_scene(f, NULL);
    return hash;
}

static void equal_sets_count_as_one(void **state) {
    lobe_scene *one = plane(0, 1), *equal = plane(1, 1), *other = plane(1, 2),
               *swapped = plane(0, 1);
    swapped->materials[0].normal_map.texture_coordinates = 1;
    for (size_t i = 0; i < METHODS; i++) {
        const uint64_t expected = new_picture(*state, one, methods[i], true);
        assert_true(new_picture(*state, equal, methods[i], true) == expected);
        assert_true(new_picture(*state, swapped, methods[i], true) == expected);
        assert_false(new_picture(*state, other, methods[i], false) == expected);
    }
    lobe_scene_destroy(&one);
    lobe_scene_destroy(&equal);
    lobe_scene_destroy(&other);
    lobe_scene_destroy(&swapped);
}

/// What a mesh does not have is not equal to anything.
static void missing_sets_are_not_equal(void **state) {
    for (int set = 0; set < 2; set++) {
        lobe_scene *scene = plane(1, 1);
        scene->meshes[0].has_texture_coordinates[set] = false;
        new_picture(*state, scene, methods[0], false);
        lobe_scene_destroy(&scene);
    }
}

/// Nor is what the host gives on the device, which may differ in each frame.
static void given_vertices_are_not_equal(void **state) {
    fixture *f = *state;
    lobe_scene *scene = plane(1, 1);
    for (int given = 0; given < 2; given++) {
        device_scene *uploaded;
        scene->meshes[0].on_device = given;
        assert_int_equal(
            passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded), LOBE_OK);
        assert_true(uploaded->materials[0].equal_sets == !given);
        passes_device_scene_destroy(&uploaded);
    }
    lobe_scene_destroy(&scene);
}

static void meshes_may_change(void **state) {
    static const uint32_t first = 0;
    const lobe_scene_changes changes = {.meshes = &first, .mesh_count = 1};
    fixture *f = *state;
    lobe_scene *scene = plane(1, 1), *other = plane(1, 2);
    for (size_t i = 0; i < METHODS; i++) {
        const uint64_t apart = new_picture(f, other, methods[i], false);
        hold_scene(f, scene);
        const uint64_t alike = picture(f, methods[i], true);
        add_second_set(&scene->meshes[0], 2);
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        assert_true(picture(f, methods[i], false) == apart);
        add_second_set(&scene->meshes[0], 1);
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        assert_true(picture(f, methods[i], true) == alike);
        hold_scene(f, NULL);
    }
    lobe_scene_destroy(&scene);
    lobe_scene_destroy(&other);
}

/// The same of the plane as metal: bins keep colours of their own only where maps lie alike.
static uint64_t metal_picture(fixture *f) {
    const picture_request request = {
        .filter = "moments", .settings = {"colour=bins"}, .width = WIDTH, .height = WIDTH};
    lobe_frame frame = draw(f, &request);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

static lobe_scene *metal_plane(float scale) {
    lobe_scene *scene = plane(1, scale);
    lobe_material *material = &scene->materials[0];
    material->model = LOBE_MATERIAL_MICROFACET;
    material->distribution = LOBE_DISTRIBUTION_GGX;
    material->roughness = 0.5f;
    material->metallic = 1;
    return scene;
}

static void what_filters_keep_is_made_anew(void **state) {
    static const uint32_t first = 0;
    const lobe_scene_changes changes = {.meshes = &first, .mesh_count = 1};
    static const float scales[] = {1, 2, 1};
    fixture *f = *state;
    lobe_scene *scene = metal_plane(2), *fresh[2] = {metal_plane(1), metal_plane(2)};
    uint64_t expected[2];
    for (int i = 0; i < 2; i++) {
        hold_scene(f, fresh[i]);
        expected[i] = metal_picture(f);
    }
    hold_scene(f, scene);
    assert_true(metal_picture(f) == expected[1]);
    for (int i = 0; i < 3; i++) {
        add_second_set(&scene->meshes[0], scales[i]);
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        assert_true(metal_picture(f) == expected[i % 2]);
    }
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
    for (int i = 0; i < 2; i++)
        lobe_scene_destroy(&fresh[i]);
}

/// All meshes with the material count; those without it do not.
static void instances_may_change(void **state) {
    static const uint32_t second = 1;
    const lobe_scene_changes changes = {.instances = &second, .instance_count = 1};
    static const float aside[16] = {1, [5] = 1, [10] = 1, [12] = 10, [15] = 1};
    fixture *f = *state;
    lobe_scene *scene = plane(1, 1);
    const lobe_material plain = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0);
    scene_add_square(scene, &plain, 1, aside);
    add_second_set(&scene->meshes[1], 2);
    scene_end(scene);
    hold_scene(f, scene);
    const uint64_t alike = picture(f, methods[0], true);
    scene->instances[1].material = 0;
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    assert_false(picture(f, methods[0], false) == alike);
    scene->instances[1].mesh = 0;
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    assert_true(picture(f, methods[0], true) == alike);
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
}

/// The material may change to the other set and back.
static void materials_may_change(void **state) {
    static const uint32_t first = 0;
    const lobe_scene_changes changes = {.materials = &first, .material_count = 1};
    fixture *f = *state;
    lobe_scene *scenes[2] = {plane(1, 1), plane(1, 2)};
    for (int i = 0; i < 2; i++) {
        uint32_t *set = &scenes[i]->materials[0].base_colour_map.texture_coordinates;
        hold_scene(f, scenes[i]);
        const uint64_t before = picture(f, methods[0], i == 0);
        *set = 0;
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        assert_true((picture(f, methods[0], true) == before) == (i == 0));
        *set = 1;
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        assert_true(picture(f, methods[0], i == 0) == before);
        hold_scene(f, NULL);
        lobe_scene_destroy(&scenes[i]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_sets_count_as_one),
        cmocka_unit_test(missing_sets_are_not_equal),
        cmocka_unit_test(given_vertices_are_not_equal),
        cmocka_unit_test(meshes_may_change),
        cmocka_unit_test(what_filters_keep_is_made_anew),
        cmocka_unit_test(instances_may_change),
        cmocka_unit_test(materials_may_change),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
