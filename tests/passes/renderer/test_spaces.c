// The space in which mixtures are built must not show on a flat surface: one lobe gives the same
// picture in tangent, object and camera space, wherever the surface is and from whichever side it
// is seen.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 24 };

typedef struct placement {
    const char *name;
    float transform[16];
    double viewer[3];
    bool perspective;
} placement;

static const placement placements[] = {
    {"as it is", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {0.3, 1, 0.4}, false},
    {"turned and scaled",
     {0, 0.6f, 0.8f, 0, 0, 0.8f, -0.6f, 0, -1, 0, 0, 0, 0.1f, 0, 0, 1},
     {0.2, 1, -0.5},
     false},
    {"small", {0, 0.3f, 0.4f, 0, 0, 0.4f, -0.3f, 0, -0.5f, 0, 0, 0, 0, 0, 0, 1}, {0, 1, 0}, true},
    {"mirrored", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {0.3, 1, 0.4}, false},
    {"from behind", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {0.3, -1, 0.4}, true},
    {"mirrored, from behind",
     {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1},
     {0.3, -1, 0.4},
     false},
    // Lengths change by different factors along the axes.
    {"stretched", {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1}, {0.3, 1, 0.4}, false},
    {"stretched and turned",
     {1.6f, 1.2f, 0, 0, -0.3f, 0.4f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
     {0.3, 1, 0.4},
     false},
};

static lobe_scene *placed_scene(const placement *where, bool microfacet) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    if (microfacet)
        lobe_material_default(&material);
    material.roughness = 0.5f;
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 0.5f;
    material.double_sided = true;
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.6, 51));
    scene_add_square(scene, &material, 1, where->transform);
    scene_add_sun(scene, (double[]){0.2, 1, 0.1}, 1);
    scene_add_sun(scene, (double[]){-0.4, 1, 0.5}, 2);
    scene_add_sun(scene, (double[]){0.1, -1, 0.3}, 2);
    scene_look_from(scene, where->viewer, 2);
    scene->camera.vertical_field_of_view = where->perspective ? 0.4f : 0;
    scene_end(scene);
    return scene;
}

static void check_placement(fixture *f, const placement *where, bool microfacet) {
    static const char *const spaces[] = {"space=tangent", "space=object", "space=camera"};
    lobe_scene *scene = placed_scene(where, microfacet);
    lobe_frame frames[3];
    for (int i = 0; i < 3; i++) {
        picture_request request = {.filter = "lobes",
                                   .settings = {spaces[i], "subdivision=0", NULL},
                                   .width = EXTENT,
                                   .height = EXTENT};
        frames[i] = draw_scene(f, scene, &request);
        assert_true(largest_value(&frames[i].radiance) > 0.01);
        double error = relative_l2(&frames[i].radiance, &frames[0].radiance);
        if (!(error < 1e-3))
            fail_msg("%s, %s: %g off tangent space", where->name, spaces[i], error);
    }
    for (int i = 0; i < 3; i++)
        lobe_frame_free(&frames[i]);
    lobe_scene_destroy(&scene);
}

static void half_vector_lobes_look_alike(void **state) {
    for (size_t i = 0; i < sizeof placements / sizeof *placements; i++)
        check_placement(*state, &placements[i], false);
}

static void microfacets_look_alike(void **state) {
    for (size_t i = 0; i < sizeof placements / sizeof *placements; i++)
        check_placement(*state, &placements[i], true);
}

/// A square whose coordinates leave most of its atlas empty, seen at levels whose texels are partly
/// empty: the covered part represents the texel.
static void the_edge_of_an_atlas_is_no_darker(void **state) {
    static const char *const spaces[] = {"space=tangent", "space=object", "space=camera"};
    for (int microfacet = 0; microfacet < 2; microfacet++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
        if (microfacet)
            lobe_material_default(&material);
        material.roughness = 0.5f;
        material.normal_map = scene_add_map(scene, constant_map(32, 32, 0.6f, 0.4f, 0.98f));
        scene_add_square(scene, &material, 1, NULL);
        lobe_mesh *mesh = &scene->meshes[0];
        for (size_t i = 0; i < mesh->vertex_count; i++) {
            mesh->vertices[i].texture_coordinates[0][0] *= 13 / 32.0f;
            mesh->vertices[i].texture_coordinates[0][1] *= 11 / 32.0f;
        }
        scene_add_sun(scene, (double[]){0.2, 1, 0.1}, 1);
        scene_look_from(scene, (double[]){0.3, 1, 0.4}, 2.2);
        scene_end(scene);
        lobe_frame frames[3];
        for (int i = 0; i < 3; i++) {
            picture_request request = {
                .filter = "lobes", .settings = {spaces[i], NULL}, .width = 3, .height = 3};
            frames[i] = draw_scene(*state, scene, &request);
            assert_true(largest_value(&frames[i].radiance) > 0.01);
            double error = relative_l2(&frames[i].radiance, &frames[0].radiance);
            if (!(error < 2e-3))
                fail_msg("%s: %g off tangent space", spaces[i], error);
        }
        for (int i = 0; i < 3; i++)
            lobe_frame_free(&frames[i]);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_vector_lobes_look_alike),
        cmocka_unit_test(microfacets_look_alike),
        cmocka_unit_test(the_edge_of_an_atlas_is_no_darker),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
