// The number of clusters chosen automatically: as few as come close to the material's lobes.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "passes/filters/lobes/subdivision_choice.h"
#include "passes/upload/scene_upload.h"
#include "shaders/interface/cluster.h"
#include "shaders/interface/mixture.h"
#include "tests/passes/support/scene_builder.h"

/// Uploads a scene of one square and returns the choice for its material.
static uint32_t choose(fixture *f, lobe_scene *scene, const lobe_material *material) {
    scene_end_with_square(scene, material);
    device_scene *uploaded;
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded),
                     LOBE_OK);
    const subdivision_request request = {.clusters = CLUSTERS_TURNED,
                                         .widths = 2,
                                         .threshold = THRESHOLD_DISPERSION,
                                         .epsilon0 = 0.95,
                                         .epsilon1 = 0.85,
                                         .blend = 0.02};
    uint32_t subdivision = passes_subdivision_choose(uploaded, &uploaded->materials[0], &request);
    passes_device_scene_destroy(&uploaded);
    lobe_scene_destroy(&scene);
    return subdivision;
}

/// A map of normals tilted from the pole towards an azimuth, both in degrees, texel by texel in
/// turn.
static lobe_image normals_in_turn(uint32_t width, uint32_t height, const double (*angles)[2],
                                  uint32_t count) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    for (uint32_t i = 0; i < width * height; i++) {
        const double *angle = angles[(i % width + i / width) % count];
        double tilt = angle[0] * M_PI / 180, azimuth = angle[1] * M_PI / 180;
        float *texel = (float *)image.texels + 4 * i;
        texel[0] = (float)(0.5 + 0.5 * sin(tilt) * cos(azimuth));
        texel[1] = (float)(0.5 + 0.5 * sin(tilt) * sin(azimuth));
        texel[2] = (float)(0.5 + 0.5 * cos(tilt));
    }
    return image;
}

static uint32_t choose_for_normals(fixture *f, float width, const double (*angles)[2],
                                   uint32_t count) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, width);
    material.normal_map = scene_add_map(scene, normals_in_turn(64, 48, angles, count));
    material.normal_map.nearest = true;
    return choose(f, scene, &material);
}

static void as_many_as_directions_need(void **state) {
    static const double flat[][2] = {{0, 0}};
    static const double nearly_flat[][2] = {{1, 0}, {1, 120}, {1, 240}};
    static const double two_sides[][2] = {{30, 0}, {30, 180}};
    static const double one_side[][2] = {{2, 5}, {35, 5}};
    assert_int_equal(choose_for_normals(*state, 20, flat, 1), 0);
    assert_int_equal(choose_for_normals(*state, 20, nearly_flat, 3), 0);
    // Sectors distinguish opposite sides, halves distinguish tilted from upright lobes.
    assert_int_equal(choose_for_normals(*state, 300, two_sides, 2), 1);
    assert_int_equal(choose_for_normals(*state, 300, one_side, 2), 2);
    // Lobes so broad that neither is visible.
    assert_int_equal(choose_for_normals(*state, 0.05f, one_side, 2), 0);
}

/// What a mask cuts away asks for no clusters, and where it keeps nothing there is a choice.
static void what_a_mask_cuts_does_not_count(void **state) {
    static const double one_side[][2] = {{2, 5}, {35, 5}};
    typedef enum kept { ALL, LEVEL, NOTHING } kept;
    static const uint32_t choices[] = {[ALL] = 2, [LEVEL] = 0, [NOTHING] = 2};
    for (kept c = ALL; c <= NOTHING; c++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 300);
        material.normal_map = scene_add_map(scene, normals_in_turn(64, 48, one_side, 2));
        lobe_image colours = map_image(LOBE_FORMAT_RGBA8_SRGB, 64, 48);
        for (uint32_t i = 0; i < 64 * 48; i++) {
            bool level = (i % 64 + i / 64) % 2 == 0;
            ((unsigned char *)colours.texels)[4 * i + 3] =
                c == ALL || (c == LEVEL && level) ? 255 : 100;
        }
        material.base_colour_map = scene_add_map(scene, colours);
        material.normal_map.nearest = material.base_colour_map.nearest = true;
        material.alpha_mask = true;
        material.alpha_cutoff = 0.5f;
        assert_int_equal(choose(*state, scene, &material), choices[c]);
    }
}

/// Two base lobes on opposite sides, like those of a woven cloth, need sectors even if the normals
/// are flat.
static void base_lobes_count_as_well(void **state) {
    static const double flat[][2] = {{0, 0}};
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, 128);
    material.lobe_count = 2;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 128, {1, 1, 1}};
    material.lobes[1] = (lobe_base_lobe){{-0.6f, 0, 0.8f}, 128, {1, 1, 1}};
    material.normal_map = scene_add_map(scene, normals_in_turn(32, 32, flat, 1));
    assert_int_equal(choose(*state, scene, &material), 1);
}

/// Slopes at random, normally distributed.
static lobe_image spread_normals(double deviation) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, 64, 64);
    for (uint32_t i = 0; i < 64 * 64; i++) {
        const double part = (i * 1597u % 4096 + 0.5) / 4096, angle = 2.4 * i;
        const double slope = deviation * sqrt(-2 * log(part)),
                     scale = 0.5 / sqrt(1 + slope * slope);
        float *texel = (float *)image.texels + 4 * i;
        texel[0] = (float)(0.5 + scale * slope * cos(angle));
        texel[1] = (float)(0.5 + scale * slope * sin(angle));
        texel[2] = (float)(0.5 + scale);
    }
    return image;
}

static uint32_t choose_for_metal(fixture *f, lobe_distribution distribution) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(distribution, 0.6, 1);
    material.normal_map = scene_add_map(scene, spread_normals(0.4));
    material.normal_map.nearest = true;
    return choose(f, scene, &material);
}

/// Four lobes leave a dip between them. That of GGX is deeper, so that eight are better; where the
/// lobes fall off faster, four are about as good.
static void shapes_of_microfacets_count(void **state) {
    assert_int_equal(choose_for_metal(*state, LOBE_DISTRIBUTION_GGX), 2);
    assert_int_equal(choose_for_metal(*state, LOBE_DISTRIBUTION_BECKMANN), 1);
}

/// Maps of any size give a choice; for formats that the host cannot read it is eight clusters.
static void any_map_has_an_answer(void **state) {
    static const double one_side[][2] = {{2, 5}, {35, 5}};
    static const uint32_t sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {2, 2}, {25, 23}, {671, 3}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material;
        lobe_material_default(&material);
        material.roughness = 0.2f;
        material.normal_map =
            scene_add_map(scene, normals_in_turn(sizes[i][0], sizes[i][1], one_side, 2));
        material.metallic_roughness_map = scene_add_map(scene, random_map(5, 3, 0.2, 1, 171));
        assert_in_range(choose(*state, scene, &material), 0, 2);
    }
    static const lobe_format formats[] = {LOBE_FORMAT_RGBA16_FLOAT, LOBE_FORMAT_RGBA16_SNORM,
                                          LOBE_FORMAT_RGBA8_UNORM, LOBE_FORMAT_RGBA16_UNORM};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 100);
        // All zero: straight down in snorm, no direction otherwise.
        material.normal_map = scene_add_map(scene, map_image(formats[i], 8, 8));
        assert_in_range(choose(*state, scene, &material), 0, 2);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_many_as_directions_need),
        cmocka_unit_test(what_a_mask_cuts_does_not_count),
        cmocka_unit_test(base_lobes_count_as_well),
        cmocka_unit_test(shapes_of_microfacets_count),
        cmocka_unit_test(any_map_has_an_answer),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
