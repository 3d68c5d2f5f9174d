// What the device finds of a material's lobes against what the host does: the extremes of all of
// them, and a sample that stands for all texels and has what is rare.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "passes/filters/moments/cell_survey.h"
#include "passes/filters/moments/survey.h"
#include "passes/upload/material_lobes.h"
#include "shaders/interface/moment_refit.h"
#include "tests/passes/filters/moments/changed_map.h"
#include "tests/passes/support/scene_builder.h"

enum {
    CELLS = SURVEY_CELLS * SURVEY_CELLS,
    LOBES = CELLS * SURVEY_DRAWS * LOBE_MATERIAL_MAXIMUM_LOBES,
};

/// What the device found.
typedef struct findings {
    cell_survey survey;
    struct survey_extremes extremes[CELLS];
    float4 lobes[LOBES];
    float least[8]; ///< of the cells' extremes
    double total;   ///< weight
} findings;

static findings found;

static void take_findings(fixture *f) {
    copy_read_back(f, found.survey.extremes, found.extremes,
                   found.survey.cells * sizeof *found.extremes);
    copy_read_back(f, found.survey.lobes, found.lobes,
                   found.survey.lobe_count * sizeof *found.lobes);
    for (int i = 0; i < 8; i++)
        found.least[i] = INFINITY;
    for (uint32_t i = 0; i < found.survey.cells; i++)
        for (int j = 0; j < 4; j++) {
            found.least[j] = fminf(found.least[j], found.extremes[i].places[j]);
            found.least[4 + j] = fminf(found.least[4 + j], found.extremes[i].factors[j]);
        }
    found.total = 0;
    for (uint32_t i = 0; i < found.survey.lobe_count; i++)
        found.total += (double)found.lobes[i][3];
}

/// Surveys the lobes of a scene of one square on both. The host's is freed with lobe_release.
static lobe_survey *survey_both(fixture *f, lobe_scene *scene, const lobe_material *material,
                                bool bright_texels, uint32_t part) {
    scene_end_with_square(scene, material);
    pass_run run;
    pass_run_begin(&run, f, scene, "moments", (const char *[]){NULL});
    found.survey = passes_moment_cell_survey_declare(&run.context, 0);
    passes_moment_cell_survey(&run.context, 0, bright_texels, part, &found.survey);
    lobe_graph_read_back(f->graph, found.survey.extremes, (lobe_range){0});
    lobe_graph_read_back(f->graph, found.survey.lobes, (lobe_range){0});
    pass_run_execute(&run);
    take_findings(f);
    lobe_survey *survey = passes_lobe_survey_make(run.scene, &run.scene->materials[0], NULL);
    assert_non_null(survey);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
    assert_int_equal(f->errors, 0);
    return survey;
}

/// The range of a survey is that of the other: neither less nor more.
static void check_places(const lobe_survey *survey, const char *name) {
    for (int axis = 0; axis < 2; axis++) {
        double low = (double)found.least[axis], high = -(double)found.least[2 + axis];
        if (!(fabs(low - survey->range.low[axis]) < 2e-6 &&
              fabs(high - survey->range.high[axis]) < 2e-6))
            fail_msg("%s, axis %d: [%g, %g] instead of [%g, %g]", name, axis, low, high,
                     survey->range.low[axis], survey->range.high[axis]);
    }
}

static lobe_material leaning_lobes(void) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.lobe_count = 2;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
    material.lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 3, {0.1f, 0.2f, 0.3f}};
    return material;
}

static const struct {
    const char *name;
    make_normals make;
    uint32_t width, height;
    double amount;
} maps[] = {
    {"bumps", round_bumps, 64, 64, 0.4},     {"grooves", grooves_along_x, 100, 37, 0.6},
    {"facets", three_facets, 300, 200, 0.5}, {"one slope", one_slope, 40, 50, 0.3},
    {"noise", noisy_normals, 3, 5, 0.9},     {"noise", noisy_normals, 671, 3, 0.9},
    {"noise", noisy_normals, 1, 2, 0.5},     {"one deviates", one_deviating, 517, 260, 1.5},
};
enum { MAPS = sizeof maps / sizeof *maps };

/// Of normals and of lobes that lean away from them; also of a width map of another size.
static void extremes_are_those_of_all_texels(void **state) {
    for (int i = 0; i < 2 * MAPS; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material =
            i < MAPS ? microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0) : leaning_lobes();
        const uint32_t width = maps[i % MAPS].width, height = maps[i % MAPS].height;
        material.normal_map =
            scene_add_map(scene, maps[i % MAPS].make(width, height, maps[i % MAPS].amount));
        lobe_image widths = random_map(height, 7, 0.3, 1, 60 + (uint64_t)i);
        float low = 1, high = 0;
        for (uint32_t k = 0; k < height * 7; k++) {
            const float factor = ((float *)widths.texels)[(size_t)4 * k + (i < MAPS)];
            low = fminf(low, factor);
            high = fmaxf(high, factor);
        }
        *(i < MAPS ? &material.metallic_roughness_map : &material.width_map) =
            scene_add_map(scene, widths);
        lobe_survey *survey = survey_both(*state, scene, &material, false, 0);
        check_places(survey, maps[i % MAPS].name);
        assert_true(found.least[4] == low && found.least[5] == -high);
        lobe_release(survey);
    }
}

/// Of a part, the range is within that of all texels, and nearly the same.
static void check_reach(const lobe_survey *survey, const char *name) {
    for (int axis = 0; axis < 2; axis++) {
        const double all = survey->range.high[axis] - survey->range.low[axis];
        const double low = (double)found.least[axis], high = -(double)found.least[2 + axis];
        if (!(low > survey->range.low[axis] - 2e-6 && high < survey->range.high[axis] + 2e-6 &&
              high - low > 0.8 * all - 1e-6))
            fail_msg("%s, axis %d: [%g, %g] of [%g, %g]", name, axis, low, high,
                     survey->range.low[axis], survey->range.high[axis]);
    }
}

/// The weights add up to the texels; without a bias of the mean. Also where only a part of the
/// texels is read.
static void the_sample_stands_for_all_texels(void **state) {
    for (int i = 0; i < 2 * MAPS; i++) {
        const uint32_t part = i < MAPS ? 0 : 4;
        const char *name = maps[i % MAPS].name;
        const uint32_t width = maps[i % MAPS].width, height = maps[i % MAPS].height;
        lobe_scene *scene = scene_begin();
        lobe_material material = leaning_lobes();
        const double texels = (double)width * height;
        material.normal_map =
            scene_add_map(scene, maps[i % MAPS].make(width, height, maps[i % MAPS].amount));
        lobe_survey *survey = survey_both(*state, scene, &material, false, part);
        double mean[2] = {0}, expected[2] = {0}, total = 0;
        for (uint32_t k = 0; k < found.survey.lobe_count; k++)
            mean[k % 2] += (double)found.lobes[k][3] * (double)found.lobes[k][0] / texels;
        for (uint32_t k = 0; k < survey->count; k++) {
            expected[k % 2] += survey->samples[k].weight * survey->samples[k].place[0];
            total += survey->samples[k].weight;
        }
        for (int k = 0; k < 2; k++)
            if (!(fabs(mean[k] - expected[k] / total) < 0.02))
                fail_msg("%s: the mean place of lobe %d is %g instead of %g", name, k, mean[k],
                         expected[k] / total);
        if (!(fabs(found.total / texels - 1) < (texels <= CELLS ? 1e-4 : 0.05)))
            fail_msg("%s: %g lobes stand for %g texels", name, found.total, texels);
        if (part > 0 && maps[i % MAPS].make != one_deviating)
            check_reach(survey, name);
        lobe_release(survey);
    }
}

/// A single steep texel in a hundred thousand is in the sample, as is a single smooth one.
static void what_is_rare_is_seen(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.3, 0);
    lobe_image widths = constant_map(400, 300, 0, 0.8f, 1);
    ((float *)widths.texels)[4 * 77777 + 1] = 0.2f;
    material.normal_map = scene_add_map(scene, one_deviating(400, 300, 1));
    material.metallic_roughness_map = scene_add_map(scene, widths);
    lobe_release(survey_both(*state, scene, &material, false, 0));
    double steep = 0, smooth = 0, usual = INFINITY;
    for (uint32_t k = 0; k < found.survey.lobe_count; k++)
        usual = fmin(usual, -(double)found.lobes[k][2]);
    for (uint32_t k = 0; k < found.survey.lobe_count; k++) {
        steep += (double)found.lobes[k][0] < -0.3 ? (double)found.lobes[k][3] : 0;
        smooth += (double)found.lobes[k][2] < -0.5 * usual ? (double)found.lobes[k][3] : 0;
    }
    if (!(steep > 0.3 && steep < 3 && smooth > 0.3 && smooth < 3))
        fail_msg("%g texels are steep, %g smooth, instead of one each", steep, smooth);
}

/// Only where asked for, and at least 1.
static void bright_texels_are_found(void **state) {
    for (int i = 0; i < 3; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 40);
        material.normal_map = scene_add_map(scene, round_bumps(65, 40, 0.3));
        lobe_image colours = constant_map(33, 40, 0.5f, 0.5f, 0.5f);
        ((float *)colours.texels)[4 * 1000 + 2] = i > 0 ? 7 : 0.75f;
        material.specular_map = scene_add_map(scene, colours);
        lobe_release(survey_both(*state, scene, &material, i < 2, 0));
        assert_true(-found.least[6] == (i == 1 ? 7.0f : 1.0f));
    }
}

enum { MASKED_WIDTH = 256, MASKED_HEIGHT = 192, KEPT_COLUMNS = 4 };

/// Surveys a map of which a mask keeps some columns: their normals lean to one side, those of all
/// others to the other.
static void survey_columns(fixture *f, bool nearest) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.3f, 0);
    lobe_image normals = map_image(LOBE_FORMAT_RGBA32_FLOAT, MASKED_WIDTH, MASKED_HEIGHT);
    lobe_image colours = map_image(LOBE_FORMAT_RGBA8_SRGB, MASKED_WIDTH, MASKED_HEIGHT);
    for (uint32_t i = 0; i < MASKED_WIDTH * MASKED_HEIGHT; i++) {
        const bool kept = i % MASKED_WIDTH < KEPT_COLUMNS;
        float *normal = (float *)normals.texels + (size_t)4 * i;
        normal[0] = kept ? 0.7f : i % 2 ? 0.2f : 0.4f;
        normal[1] = 0.5f;
        normal[2] = 0.9f;
        ((unsigned char *)colours.texels)[(size_t)4 * i + 3] = kept ? 200 : 100;
    }
    material.normal_map = scene_add_map(scene, normals);
    material.base_colour_map = scene_add_map(scene, colours);
    material.normal_map.nearest = material.base_colour_map.nearest = nearest;
    material.alpha_mask = true;
    material.alpha_cutoff = 0.5f;
    lobe_survey *survey = survey_both(f, scene, &material, false, 0);
    check_places(survey, nearest ? "masked" : "masked, interpolated");
    lobe_release(survey);
}

/// What a mask cuts away counts next to nothing, also in what is usual: a few kept texels among
/// many that lie elsewhere are most of the sample.
static void the_sample_is_of_what_a_mask_keeps(void **state) {
    survey_columns(*state, true);
    const double expected = KEPT_COLUMNS * MASKED_HEIGHT;
    const double rest = (MASKED_WIDTH - KEPT_COLUMNS) * MASKED_HEIGHT / 16384.0;
    double kept = 0;
    for (uint32_t k = 0; k < found.survey.lobe_count; k++)
        kept += found.lobes[k][0] > 0 ? (double)found.lobes[k][3] : 0;
    if (!(fabs(kept / expected - 1) < 0.01 && fabs(found.total - kept - rest) < 0.05 * rest))
        fail_msg("%g kept and %g cut instead of %g and %g", kept, found.total - kept, expected,
                 rest);
}

/// Interpolated alpha meets the cutoff a part of a texel beyond the kept columns, on either side.
static void the_sample_is_of_what_a_mask_keeps_of_texels(void **state) {
    survey_columns(*state, false);
    const double beyond = (200 - 127.5) / (200 - 100) - 0.5;
    const double columns = KEPT_COLUMNS + 2 * beyond;
    const double expected = MASKED_HEIGHT * (columns + (MASKED_WIDTH - columns) / 16384.0);
    if (!(fabs(found.total / expected - 1) < 0.03))
        fail_msg("%g texels instead of %g", found.total, expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extremes_are_those_of_all_texels),
        cmocka_unit_test(the_sample_stands_for_all_texels),
        cmocka_unit_test(the_sample_is_of_what_a_mask_keeps),
        cmocka_unit_test(the_sample_is_of_what_a_mask_keeps_of_texels),
        cmocka_unit_test(what_is_rare_is_seen),
        cmocka_unit_test(bright_texels_are_found),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
