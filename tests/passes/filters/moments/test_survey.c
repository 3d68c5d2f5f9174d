// What is known of a material's lobes: extremes of all of them, and a sample that no period of the
// maps can deceive and that has what is rare.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "passes/filters/moments/coreset.h"
#include "passes/filters/moments/survey.h"
#include "passes/upload/scene_upload.h"
#include "tests/passes/support/scene_builder.h"

/// Free with lobe_release.
static lobe_survey *survey_of(fixture *f, lobe_scene *scene, const lobe_material *material) {
    scene_end_with_square(scene, material);
    device_scene *uploaded;
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded),
                     LOBE_OK);
    lobe_survey *survey = passes_lobe_survey_make(uploaded, &uploaded->materials[0], NULL);
    assert_non_null(survey);
    passes_device_scene_destroy(&uploaded);
    lobe_scene_destroy(&scene);
    return survey;
}

/// Sets the normal of a texel (RGBA8) from its slope along x.
static void set_slope(lobe_image *image, uint32_t x, uint32_t y, double slope) {
    unsigned char *texel = (unsigned char *)image->texels + 4 * ((size_t)y * image->width + x);
    double length = sqrt(1 + slope * slope);
    texel[0] = (unsigned char)lround(127.5 - 127.5 * slope / length);
    texel[1] = 128;
    texel[2] = (unsigned char)lround(127.5 + 127.5 / length);
    texel[3] = 255;
}

/// A V in each period of `pitch` columns, moved by `lean` columns from row to row.
static lobe_image grooves(uint32_t width, uint32_t height, uint32_t pitch, uint32_t lean) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA8_UNORM, width, height);
    for (uint32_t i = 0; i < width * height; i++) {
        uint32_t x = i % width, y = i / width, phase = (x + lean * y) % pitch;
        set_slope(&image, x, y, phase == pitch / 2 ? 0.6 : phase == pitch / 2 - 1 ? -0.6 : 0);
    }
    return image;
}

/// The part of a survey's weight in lobes on one side, or about the middle.
static double part_of(const lobe_survey *survey, int side) {
    double part = 0, total = 0;
    for (uint32_t i = 0; i < survey->count; i++) {
        const plane_sample *sample = &survey->samples[i];
        total += sample->weight;
        if ((sample->place[0] > 0.2) - (sample->place[0] < -0.2) == side)
            part += sample->weight;
    }
    return part / total;
}

static void grooves_of_any_pitch(void **state) {
    static const uint32_t pitches[] = {3, 4, 7, 8, 16, 31, 32, 64}, widths[] = {256, 1000, 2048};
    for (uint32_t i = 0; i < 8 * 3 * 2; i++) {
        const uint32_t pitch = pitches[i % 8], width = widths[i / 8 % 3];
        lobe_scene *scene = scene_begin();
        lobe_material material;
        lobe_material_default(&material);
        material.roughness = 0.3f;
        material.normal_map = scene_add_map(scene, grooves(width, 128, pitch, i / 24));
        material.normal_map.nearest = true;
        lobe_survey *survey = survey_of(*state, scene, &material);
        for (int side = -1; side <= 1; side++) {
            // A third of the part of a pitch of 64 texels is within three of its deviations.
            double expected = side ? 1.0 / pitch : 1 - 2.0 / pitch, part = part_of(survey, side);
            if (!(fabs(part / expected - 1) < 0.35))
                fail_msg("pitch %u, %u wide: %g of the lobes on side %d instead of %g", pitch,
                         width, part, side, expected);
        }
        lobe_release(survey);
    }
}

/// A few steep texels among flat ones, wherever they are, are within the range and in the sample,
/// with no more than their weight.
static void what_is_rare_is_seen(void **state) {
    for (uint32_t i = 0; i < 12; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material;
        lobe_material_default(&material);
        material.roughness = 0.1f;
        lobe_image image = grooves(300 + 7 * i, 200, 1000, 0);
        for (uint32_t k = 0; k < 20; k++)
            set_slope(&image, (uint32_t)(passes_hashed_number(100 * i + k) * image.width),
                      (k * 31 + i * 17) % 200, k == 0 ? -1.5 : -1);
        const double texels = (double)image.width * image.height;
        material.normal_map = scene_add_map(scene, image);
        lobe_survey *survey = survey_of(*state, scene, &material);
        // 2 sin(atan(1.5) / 2)
        assert_true(fabs(survey->range.high[0] - 2 * sin(0.5 * atan(1.5))) < 0.01);
        double part = part_of(survey, 1);
        if (!(part > 0.3 * 20 / texels && part < 3 * 20 / texels))
            fail_msg("map %u: %g of the lobes are steep instead of %g", i, part, 20 / texels);
        lobe_release(survey);
    }
}

/// The same for widths: one smooth texel in ten thousand.
static void rare_widths_are_seen(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.metallic_roughness_map = scene_add_map(scene, constant_map(400, 300, 0, 0.8f, 1));
    material.metallic_roughness_map.nearest = true;
    lobe_image *image = &scene->images[0].image;
    for (uint32_t k = 0; k < 12; k++)
        ((float *)image->texels)[4 * (k * 9973) + 1] = 0.2f;
    lobe_survey *survey = survey_of(*state, scene, &material);
    double part = 0, total = 0;
    for (uint32_t i = 0; i < survey->count; i++) {
        total += survey->samples[i].weight;
        if (survey->samples[i].variance < 0.01)
            part += survey->samples[i].weight;
    }
    part /= total * 12 / (400 * 300);
    assert_true(part > 0.3 && part < 3);
    assert_true(survey->range.sharpest > 0.999 / (0.04 * sqrt(0.5)));
    lobe_release(survey);
}

/// The sample is of what a mask keeps, and no smaller for how little that is.
static void the_sample_is_of_what_a_mask_keeps(void **state) {
    enum { WIDTH = 512, HEIGHT = 128, PITCH = 32 };
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = 0.3f;
    material.base_colour[3] = 0.5f;
    material.normal_map = scene_add_map(scene, grooves(WIDTH, HEIGHT, PITCH, 0));
    lobe_image colours = map_image(LOBE_FORMAT_RGBA8_SRGB, WIDTH / 2, HEIGHT);
    // One texel of each pitch, over one of slope 0.6 and a level one. Half of the others would be
    // kept without the factor of alpha.
    for (uint32_t i = 0; i < WIDTH / 2 * HEIGHT; i++)
        ((unsigned char *)colours.texels)[4 * i + 3] = i % (PITCH / 2) == PITCH / 4 ? 255
                                                       : i % 2                      ? 150
                                                                                    : 0;
    material.base_colour_map = scene_add_map(scene, colours);
    material.alpha_mask = true;
    material.alpha_cutoff = 0.4f;
    lobe_survey *survey = survey_of(*state, scene, &material);
    assert_in_range(survey->count, CORESET_TEXELS / 3, CORESET_TEXELS);
    assert_true(part_of(survey, 0) < 0.6);
    for (uint32_t i = 0; i < survey->count; i++)
        assert_true(survey->samples[i].place[0] < 1e-2);
    lobe_release(survey);
}

/// Where interpolated alpha ends inside texels, the sample is of what is kept there: of V-shaped
/// grooves whose left walls have alpha 1 and their right walls 0, all slopes from a wall's own to
/// none.
static void the_sample_is_of_what_a_mask_keeps_of_texels(void **state) {
    enum { WIDTH = 256, HEIGHT = 64 };
    static const float cutoffs[] = {0.25f, 0.5f, 0.75f};
    for (int k = 0; k < 3; k++) {
        lobe_scene *scene = scene_begin();
        lobe_material material;
        lobe_material_default(&material);
        lobe_image normals = map_image(LOBE_FORMAT_RGBA8_UNORM, WIDTH, HEIGHT);
        lobe_image colours = map_image(LOBE_FORMAT_RGBA8_SRGB, WIDTH, HEIGHT);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            set_slope(&normals, i % WIDTH, i / WIDTH, i % 2 ? 0.3 : -0.3);
            ((unsigned char *)colours.texels)[4 * i + 3] = i % 2 ? 0 : 255;
        }
        material.normal_map = scene_add_map(scene, normals);
        material.base_colour_map = scene_add_map(scene, colours);
        material.alpha_mask = true;
        material.alpha_cutoff = cutoffs[k];
        lobe_survey *survey = survey_of(*state, scene, &material);
        double mean = 0, total = 0;
        for (uint32_t i = 0; i < survey->count; i++) {
            mean += survey->samples[i].weight * survey->samples[i].place[0];
            total += survey->samples[i].weight;
        }
        // Slopes go from 0.3 at alpha 1 to -0.3 at alpha 0: the mean of some 400 that deviate by up
        // to 0.15 deviates by 0.0075.
        const double expected = 0.3 * (double)cutoffs[k];
        if (!(fabs(mean / total - expected) < 0.02))
            fail_msg("cutoff %g: mean place %g instead of about %g", (double)cutoffs[k],
                     mean / total, expected);
        lobe_release(survey);
    }
}

/// Every texel of a small map is drawn; of a large one neither too many nor too few, however much
/// they differ, and their weights stand for all of them.
static void weights_stand_for_all_texels(void **state) {
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1}, {5, 3}, {31, 33}, {640, 480}};
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t width = sizes[i / 2][0], height = sizes[i / 2][1];
        float density[640];
        static coreset set;
        passes_coreset_begin(&set, (i % 2 ? 0.01 : 1) * width * height, 0.5);
        for (uint32_t y = 0; y < height; y++) {
            for (uint32_t x = 0; x < width; x++)
                density[x] = (x + y) % 100 == 0 ? 30 : 0.5f;
            passes_coreset_add_row(&set, density, width, y);
        }
        double sum = 0, rare = 0;
        for (uint32_t k = 0; k < set.count; k++) {
            const coreset_texel *texel = &set.texels[k];
            assert_true(texel->x < width && texel->y < height);
            sum += (double)texel->weight * set.part;
            if ((texel->x + texel->y) % 100 == 0)
                rare += (double)texel->weight * set.part;
        }
        const double texels = width * height;
        assert_in_range(set.count, texels < 300 ? texels : 300, CORESET_TEXELS);
        assert_true(fabs(sum / texels - 1) < 0.1);
        if (texels > 10000)
            assert_true(fabs(rare / texels / 0.01 - 1) < 0.15);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grooves_of_any_pitch),
        cmocka_unit_test(what_is_rare_is_seen),
        cmocka_unit_test(rare_widths_are_seen),
        cmocka_unit_test(the_sample_is_of_what_a_mask_keeps),
        cmocka_unit_test(the_sample_is_of_what_a_mask_keeps_of_texels),
        cmocka_unit_test(weights_stand_for_all_texels),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
