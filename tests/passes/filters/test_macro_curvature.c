// The curvature of the surface itself under a pixel: it widens lobes where the surface is curved,
// so that small objects do not flicker, and changes nothing where it is flat. Every filter that has
// the knob is drawn with one of the two models of material, alternately, because each picture has
// shaders of its own; without maps all filters shade alike, and three are drawn.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { COLUMNS = 3, EXTENT = 35 };

static bool has_knob(const lobe_filter *filter, const char *name) {
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++) {
        if (strcmp(lobe_filter_knob(filter, i)->name, name) == 0)
            return true;
    }
    return false;
}

/// Whether a filter is drawn with a model of material.
static bool is_drawn(size_t filter, bool microfacet) {
    return filter % 2 == microfacet && has_knob(lobe_filter_get(filter), "curvature");
}

static const char *const unmapped_filters[] = {"direct", "lobes", "moments"};
enum { UNMAPPED_FILTERS = sizeof unmapped_filters / sizeof *unmapped_filters };

static lobe_material shiny(bool microfacet) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 2000);
    if (microfacet) {
        lobe_material_default(&material);
        material.metallic = 1;
        material.roughness = 0.2f;
    }
    return material;
}

// ---------------------------------------------------------------------------------------------
// Flat

static lobe_scene *plane_scene(bool microfacet) {
    lobe_scene *scene = scene_begin();
    lobe_material material = shiny(microfacet);
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.3, 171));
    scene_add_square(scene, &material, 1, NULL);
    lobe_material bare = shiny(microfacet);
    float beside[16] = {0.8f, 0.6f, 0, 0, -0.6f, 0.8f, 0, 0, 0, 0, 1, 0, 1.6f, 0.6f, 0, 1};
    scene_add_square(scene, &bare, 1, beside);
    scene_add_sun(scene, (double[]){0.1, 1, -0.8}, 2);
    scene_add_sun(scene, (double[]){-0.9, 1, -0.3}, 2);
    scene_end(scene);
    scene->camera = (lobe_camera){.eye = {0.5f, 0.9f, 1.4f},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = 0.9f,
                                  .near_plane = 0.01f};
    return scene;
}

static void check_plane(fixture *f, const char *filter) {
    picture_request request = {
        .filter = filter, .settings = {"curvature=0", NULL}, .width = 48, .height = 32};
    lobe_frame without = draw(f, &request);
    request.settings[0] = "curvature=1";
    lobe_frame with = draw(f, &request);
    assert_true(largest_value(&with.radiance) > 0.1);
    // Different code may round differently, by at most that.
    double difference = largest_difference(&with.radiance, &without.radiance);
    if (!(difference <= 1e-6 * largest_value(&without.radiance)))
        fail_msg("%s: curvature changes a plane by %g", filter, difference);
    lobe_frame_free(&without);
    lobe_frame_free(&with);
}

static void planes_have_no_curvature(void **state) {
    fixture *f = *state;
    for (int microfacet = 0; microfacet < 2; microfacet++) {
        lobe_scene *scene = plane_scene(microfacet);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (size_t i = 0; i < lobe_filter_count(); i++) {
            if (is_drawn(i, microfacet))
                check_plane(f, lobe_filter_name(lobe_filter_get(i)));
        }
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Curved

/// Rows of spheres of 2 m, each at a different subpixel position, under suns from several sides.
static lobe_scene *sphere_scene(lobe_scene *scene, const lobe_material *material, float tiles) {
    lobe_mesh mesh;
    uint32_t mesh_index, material_index;
    assert_int_equal(scenes_shape_sphere(48, 96, 2 * tiles, tiles, NULL, &mesh), LOBE_OK);
    assert_int_equal(scenes_add_mesh(scene, &mesh, NULL, &mesh_index), LOBE_OK);
    assert_int_equal(scenes_add_material(scene, "shiny", material, NULL, &material_index), LOBE_OK);
    for (int i = 0; i < COLUMNS * COLUMNS; i++) {
        float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        transform[12] = 2.27f * (float)(i % COLUMNS) - 2.3f;
        transform[14] = 2.13f * (float)(i / COLUMNS) - 2.1f;
        assert_int_equal(scenes_add_instance(scene, mesh_index, material_index, transform, NULL),
                         LOBE_OK);
    }
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_add_sun(scene, (double[]){-0.7, 1, 0.4}, 2);
    scene_add_sun(scene, (double[]){0.5, 0.6, -1}, 2);
    scene_look_down(scene, 7);
    scene_end(scene);
    return scene;
}

static lobe_frame draw_with(fixture *f, const char *filter, const char *setting, uint32_t extent) {
    picture_request request = {
        .filter = filter, .settings = {setting, NULL}, .width = extent, .height = extent};
    lobe_frame frame = draw(f, &request);
    if (!all_finite(&frame.radiance))
        fail_msg("%s, %s: not finite", filter, setting);
    return frame;
}

static void check_error(fixture *f, const char *filter, const lobe_image *truth) {
    lobe_frame frame = draw_with(f, filter, "curvature=0", truth->width);
    double without = relative_l2(&frame.radiance, truth);
    lobe_frame_free(&frame);
    frame = draw_with(f, filter, "curvature=1", truth->width);
    double with = relative_l2(&frame.radiance, truth);
    lobe_frame_free(&frame);
    print_message("# %s: error %.3f without curvature, %.3f with\n", filter, without, with);
    if (!(with < 0.25 * without))
        fail_msg("%s: error %g without curvature, %g with", filter, without, with);
}

static void check_unmapped(fixture *f, lobe_scene *scene, const lobe_image *truth) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < UNMAPPED_FILTERS; i++)
        check_error(f, unmapped_filters[i], truth);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void check_mapped(fixture *f, lobe_scene *scene, bool microfacet, const lobe_image *truth) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        if (is_drawn(i, microfacet))
            check_error(f, lobe_filter_name(lobe_filter_get(i)), truth);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// As they are, and under a map that filters filter, all of whose texels are flat.
static void small_spheres_shine_steadily(void **state) {
    for (int microfacet = 0; microfacet < 2; microfacet++) {
        lobe_material material = shiny(microfacet);
        lobe_scene *scene = sphere_scene(scene_begin(), &material, 1);
        picture_request request = {.filter = "reference",
                                   .settings = {NULL},
                                   .width = EXTENT,
                                   .height = EXTENT,
                                   .samples = 64};
        lobe_frame truth = draw_scene(*state, scene, &request);
        check_unmapped(*state, scene, &truth.radiance);
        scene = scene_begin();
        material.normal_map = scene_add_map(scene, constant_map(64, 64, 0.5f, 0.5f, 1));
        check_mapped(*state, sphere_scene(scene, &material, 4), microfacet, &truth.radiance);
        lobe_frame_free(&truth);
    }
}

/// Mixtures over an atlas already include the surface's own normals.
static void atlases_have_the_curvature_already(void **state) {
    fixture *f = *state;
    lobe_scene *scene = scene_begin();
    lobe_material material = shiny(true);
    material.normal_map = scene_add_map(scene, constant_map(256, 256, 0.5f, 0.5f, 1));
    sphere_scene(scene, &material, 0.5f);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture_request request = {.filter = "lobes",
                               .settings = {"space=object", "curvature=0", NULL},
                               .width = EXTENT,
                               .height = EXTENT};
    lobe_frame without = draw(f, &request);
    request.settings[1] = "curvature=1";
    lobe_frame with = draw(f, &request);
    request.settings[0] = "space=tangent";
    lobe_frame tangent = draw(f, &request);
    assert_true(relative_l2(&with.radiance, &without.radiance) < 1e-6);
    assert_true(relative_l2(&tangent.radiance, &without.radiance) > 1e-2);
    lobe_frame_free(&without);
    lobe_frame_free(&with);
    lobe_frame_free(&tangent);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Normals turn fastest at a silhouette, where derivatives reach beyond the surface. Light from
/// behind makes it shine; all of its curvature makes it no brighter than the sharpest lobe's peak.
static void silhouettes_stay_as_dark_as_they_are(void **state) {
    fixture *f = *state;
    for (int microfacet = 0; microfacet < 2; microfacet++) {
        lobe_material material = shiny(microfacet);
        lobe_scene *scene = sphere_scene(scene_begin(), &material, 1);
        scene_add_sun(scene, (double[]){1, -0.3, 0.2}, 2);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (size_t i = 0; i < UNMAPPED_FILTERS; i++) {
            const char *filter = unmapped_filters[i];
            lobe_frame without = draw_with(f, filter, "curvature=0", 3 * EXTENT);
            lobe_frame with = draw_with(f, filter, "curvature=4", 3 * EXTENT);
            double most = largest_value(&without.radiance), found = largest_value(&with.radiance);
            print_message("# %s: at most %g without curvature, %g with\n", filter, most, found);
            if (!(found <= most))
                fail_msg("%s: curvature makes %g of %g", filter, found, most);
            lobe_frame_free(&without);
            lobe_frame_free(&with);
        }
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_have_no_curvature),
        cmocka_unit_test(small_spheres_shine_steadily),
        cmocka_unit_test(atlases_have_the_curvature_already),
        cmocka_unit_test(silhouettes_stay_as_dark_as_they_are),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
