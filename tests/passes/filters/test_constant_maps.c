// If all texels are equal there is nothing to filter: every filter draws the same as one sample of
// the maps.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { WIDTH = 32, HEIGHT = 24 };

static const char *const distribution_names[] = {"GGX", "Beckmann", "Blinn-Phong", "vMF"};

/// A square seen near and far at once; maps of 8x8 equal texels are repeated on it a given number
/// of times.
static lobe_scene *constant_scene(lobe_material material, const float normal[3], double tiles) {
    lobe_scene *scene = scene_begin();
    material.normal_map =
        scene_add_map(scene, constant_map(8, 8, 0.5f + 0.5f * normal[0], 0.5f + 0.5f * normal[1],
                                          0.5f + 0.5f * normal[2]));
    lobe_texture_use widths = scene_add_map(scene, constant_map(4, 4, 0.8f, 0.8f, 0.5f));
    if (material.model == LOBE_MATERIAL_MICROFACET)
        material.metallic_roughness_map = widths;
    else
        material.width_map = widths;
    scene_add_square(scene, &material, tiles, NULL);
    scene_add_sun(scene, (double[]){0.2, 1, -1}, 2);
    scene_add_sun(scene, (double[]){-0.8, 1, -0.2}, 1);
    scene_end(scene);
    scene->camera = (lobe_camera){
        .eye = {0.2f, 0.9f, 1}, .up = {0, 1, 0}, .vertical_field_of_view = 1, .near_plane = 0.01f};
    return scene;
}

/// What `direct` draws, of the base lobes as they are and turned into von Mises-Fisher lobes.
typedef struct expectation {
    const char *what, *base;
    bool leans; ///< the normal does
    lobe_frame exact, lobe;
} expectation;

static lobe_frame draw_base(fixture *f, const char *filter, const char *base) {
    picture_request request = {
        .filter = filter, .settings = {base, NULL}, .width = WIDTH, .height = HEIGHT, .samples = 1};
    return draw(f, &request);
}

/// The largest difference of two pictures, relative to the brightest pixel.
static double difference(const lobe_frame *a, const lobe_frame *b) {
    return largest_difference(&a->radiance, &b->radiance) / largest_value(&b->radiance);
}

/// Whatever the lobes, the filter only has one Beckmann lobe about the normals; of GGX, LEADR has a
/// sum of Gaussians.
static bool has_beckmann_alone(const char *filter) {
    return strcmp(filter, "lean") == 0 || strcmp(filter, "leadr") == 0 ||
           strcmp(filter, "multi_leadr") == 0;
}

static bool sums_gaussians(const char *filter, const lobe_material *material, const char *base) {
    return strstr(filter, "leadr") && material->model == LOBE_MATERIAL_MICROFACET &&
           material->distribution == LOBE_DISTRIBUTION_GGX && strcmp(base, "base=exact") == 0;
}

static bool is_beckmann(const lobe_material *material, const char *base) {
    return material->model == LOBE_MATERIAL_MICROFACET &&
           material->distribution == LOBE_DISTRIBUTION_BECKMANN && strcmp(base, "base=exact") == 0;
}

/// Gaussians of projected normals, or Phong peaks, without masking: test_tan.c and test_fournier.c
/// compare them with what is printed.
static bool has_projected_lobes(const char *filter) {
    return strcmp(filter, "tan") == 0 || strcmp(filter, "fournier") == 0;
}

/// A filter may turn half-vector lobes into von Mises-Fisher lobes, but nothing else.
static void check_filter(fixture *f, const char *filter, const lobe_material *material,
                         const expectation *expected) {
    const bool summed = sums_gaussians(filter, material, expected->base);
    if (has_projected_lobes(filter) ||
        (has_beckmann_alone(filter) && !summed && !is_beckmann(material, expected->base)))
        return;
    // Over the surface's plane and masked as a height field: test_leadr.c checks how close that is.
    if (strstr(filter, "leadr") && expected->leans)
        return;
    lobe_frame frame = draw_base(f, filter, expected->base);
    double exact = difference(&frame, &expected->exact), lobe = difference(&frame, &expected->lobe);
    double found = material->model == LOBE_MATERIAL_MICROFACET ? exact : fmin(exact, lobe);
    if (!(found <= (summed ? 0.03 : 1e-3)))
        fail_msg("%s, %s, %s: differs by %g of the brightest pixel", filter, expected->what,
                 expected->base, found);
    lobe_frame_free(&frame);
}

static void check_base(fixture *f, const lobe_material *material, const char *what,
                       const char *base, bool leans) {
    expectation expected = {what, base, leans, draw_base(f, "direct", base),
                            draw_base(f, "direct", "base=lobe")};
    assert_true(largest_value(&expected.exact.radiance) > 0.01);
    const size_t first = (size_t)material->distribution + material->lobe_count;
    for (size_t i = long_runs() ? 0 : first % 3; i < lobe_filter_count(); i += long_runs() ? 1 : 3)
        check_filter(f, lobe_filter_name(lobe_filter_get(i)), material, &expected);
    lobe_frame_free(&expected.exact);
    lobe_frame_free(&expected.lobe);
}

/// Level 1 and above, and once level 0. `turned`: also with base lobes turned into von Mises-Fisher
/// lobes, of normals that lean; it is the same code for all materials of a model.
static void check_material(fixture *f, const lobe_material *material, bool turned) {
    static const float normals[][3] = {
        {0, 0, 1}, {0.28f, 0, 0.96f}, {-0.36f, 0.48f, 0.8f}, {-0.36f, 0.48f, 0.8f}};
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    for (int i = 0; i < 4; i++) {
        const float *normal = normals[i];
        double tiles = i < 3 ? 60 : 1;
        lobe_scene *scene = constant_scene(*material, normal, tiles);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        char what[128];
        snprintf(what, sizeof what, "%u %s %s, normal (%g, %g, %g), %g tiles",
                 microfacet ? 1 : material->lobe_count, distribution_names[material->distribution],
                 microfacet ? "microfacets" : "half-vector lobes", (double)normal[0],
                 (double)normal[1], (double)normal[2], tiles);
        check_base(f, material, what, "base=exact", i > 0);
        if (turned && i == 2)
            check_base(f, material, what, "base=lobe", true);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

static void microfacets_stay_as_they_are(void **state) {
    for (int distribution = 0; distribution < 4; distribution++) {
        lobe_material material;
        lobe_material_default(&material);
        material.distribution = (lobe_distribution)distribution;
        material.roughness = 0.5f;
        material.metallic = 0.8f;
        check_material(*state, &material, distribution == LOBE_DISTRIBUTION_GGX);
    }
}

/// One lobe, and two that lean to either side of the normal.
static void half_vector_lobes_stay_as_they_are(void **state) {
    static const lobe_distribution distributions[] = {LOBE_DISTRIBUTION_BLINN_PHONG,
                                                      LOBE_DISTRIBUTION_VMF};
    for (int i = 0; i < 2; i++) {
        lobe_material material = half_vector_material(distributions[i], 60);
        material.base_colour[0] = 0.3f;
        check_material(*state, &material, false);
        material.lobe_count = 2;
        material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 60, {1, 1, 1}};
        material.lobes[1] = (lobe_base_lobe){{-0.6f, 0, 0.8f}, 30, {0.5f, 0.5f, 0.5f}};
        check_material(*state, &material, i == 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(microfacets_stay_as_they_are),
        cmocka_unit_test(half_vector_lobes_stay_as_they_are),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
