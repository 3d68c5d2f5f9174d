// Bins that the device fits to other texels of a material's maps, against what the host makes of
// those: of maps of many kinds, with lobes of all widths.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "passes/filters/moments/refit.h"
#include "passes/upload/scene_upload.h"
#include "shaders/interface/moment_refit.h"
#include "tests/passes/filters/moments/changed_map.h"
#include "tests/passes/support/moment_reference.h"
#include "tests/passes/support/scene_builder.h"

/// A map, and the one that replaces its texels.
typedef struct map_case {
    const char *name;
    make_normals first, second;
    double amounts[2];
    uint32_t width, height, bins;
    double lack; ///< log likelihood of a point that the device's fit may lack of the host's
} map_case;

/// What a refit starts from, and what comes out.
typedef struct refit {
    moment_partition first;
    struct moment_binning_constants bins;
    lobe_survey *survey; ///< of the host, of the texels that the bins were fitted to
} refit;

static const uint32_t normals = 0;

static void change_texels(pass_run *run, lobe_scene *scene, const map_case *c) {
    const lobe_scene_changes changes = {.images = &normals, .image_count = 1};
    replace_texels(scene, normals, c->second(c->width, c->height, c->amounts[1]));
    assert_int_equal(passes_device_scene_update(run->scene, &changes, &run->fixture->host),
                     LOBE_OK);
}

/// As if the host could not read the first texels.
static void forget_first(moment_partition *partition) {
    partition->has_first = false;
    partition->constants = (struct moment_binning_constants){.largest = {1, 1}};
}

/// Free `survey` with lobe_release.
static refit fit_bins(fixture *f, const map_case *c, const lobe_material *base, uint32_t kind,
                      bool has_first) {
    const partition_request request = {kind, {.bins = c->bins, .colour = BIN_COLOUR_MEAN}};
    lobe_scene *scene = scene_begin();
    lobe_material material = *base;
    refit result;
    pass_run run;
    material.normal_map = scene_add_map(scene, c->first(c->width, c->height, c->amounts[0]));
    scene_end_with_square(scene, &material);
    pass_run_begin(&run, f, scene, "moments", (const char *[]){NULL});
    assert_int_equal(passes_moment_partition_make(run.scene, 0, &request, &f->host, &result.first),
                     LOBE_OK);
    if (!has_first)
        forget_first(&result.first);
    change_texels(&run, scene, c);
    const refit_request each = {0};
    lobe_resource bins = passes_moment_refit(&run.context, 0, &result.first, &each);
    lobe_graph_read_back(f->graph, bins, (lobe_range){0});
    pass_run_execute(&run);
    copy_read_back(f, bins, &result.bins, sizeof result.bins);
    result.survey = passes_lobe_survey_make(run.scene, &run.scene->materials[0], NULL);
    assert_non_null(result.survey);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
    assert_int_equal(f->errors, 0);
    return result;
}

static refit refit_bins(fixture *f, const map_case *c, const lobe_material *base, uint32_t kind) {
    return fit_bins(f, c, base, kind, true);
}

// ---------------------------------------------------------------------------------------------
// Likelihood

/// The shares [0, 1] of bins in a lobe; returns the logarithm of the sum of likelihoods.
static double share_among(const moment_bin *bins, uint32_t count, const plane_sample *s,
                          double members[MOMENT_MAXIMUM_BINS]) {
    double most = -INFINITY, sum = 0;
    for (uint32_t k = 0; k < count; k++) {
        members[k] = reference_bin_likelihood(&bins[k], s->place, s->variance);
        most = fmax(most, members[k]);
    }
    for (uint32_t k = 0; k < count; k++)
        sum += members[k] = exp(members[k] - most);
    for (uint32_t k = 0; k < count; k++)
        members[k] /= sum;
    return most + log(sum);
}

/// The same where a part is shared as by old bins.
static double share(const refit *r, const plane_sample *s, double members[MOMENT_MAXIMUM_BINS]) {
    const double old = (double)r->bins.largest[2];
    double before[MOMENT_MAXIMUM_BINS];
    double likelihood = share_among(r->bins.bins, r->first.bins, s, members);
    if (old > 0)
        likelihood +=
            old * (share_among(r->bins.bins + MOMENT_MAXIMUM_BINS, r->first.bins, s, before) -
                   likelihood);
    for (uint32_t k = 0; old > 0 && k < r->first.bins; k++)
        members[k] += old * (before[k] - members[k]);
    return likelihood;
}

/// Of the host's samples under the device's bins.
static double likelihood_of(const refit *r) {
    double sum = 0, total = 0, members[MOMENT_MAXIMUM_BINS];
    for (uint32_t i = 0; i < r->survey->count; i++) {
        const plane_sample *sample = &r->survey->samples[i];
        sum += sample->weight * share(r, sample, members);
        total += sample->weight;
    }
    return sum / total;
}

/// The best that the host finds.
static double best_likelihood(const refit *r) {
    double best = -INFINITY;
    for (uint32_t start = 0; start < MIXTURE_STARTS; start++) {
        plane_mixture m;
        passes_mixture_fit(r->survey->samples, r->survey->count, r->first.bins,
                           (double)r->first.points, start, &m);
        best = fmax(best, m.likelihood);
    }
    return best;
}

static void check_likelihood(const refit *r, const map_case *c, size_t material) {
    const double lack = (best_likelihood(r) - likelihood_of(r)) / (double)r->first.points;
    if (!(lack <= c->lack))
        fail_msg("%s, material %zu: a point lacks %g", c->name, material, lack);
}

// ---------------------------------------------------------------------------------------------
// Units

/// Whether a lobe's moments are at most one in the units of a bin that has this share of it.
static bool fits(const moment_bin *bin, const plane_sample *s, double member) {
    const double slack = 1 + 1e-5; // of single precision
    double reach = 0;
    for (int axis = 0; axis < 2; axis++)
        reach = fmax(reach, sqrt(member) * fabs(s->place[axis] - (double)bin->range[axis]));
    return reach <= slack * (double)bin->range[2] &&
           member * s->variance <= slack * (double)bin->shape[3] &&
           member * sqrt(1 / s->variance) <= slack * (double)bin->range[3];
}

/// Of the host's sample, which is another than the device's, nearly all is held.
static void check_units(const refit *r, const map_case *c) {
    double members[MOMENT_MAXIMUM_BINS], beyond = 0, total = 0;
    for (uint32_t i = 0; i < r->survey->count; i++) {
        const plane_sample *sample = &r->survey->samples[i];
        share(r, sample, members);
        total += sample->weight;
        for (uint32_t k = 0; k < r->first.bins; k++)
            beyond += fits(&r->bins.bins[k], sample, members[k]) ? 0 : sample->weight;
    }
    if (!(beyond <= 1e-3 * total))
        fail_msg("%s: %g of the lobes are beyond the bins' units", c->name, beyond / total);
    const double mass = (double)r->bins.largest[0] / (1.001 * r->survey->range.heaviest);
    if (!(fabs(mass - 1) < 1e-4))
        fail_msg("%s: a unit of mass %g of the host's", c->name, mass);
}

// ---------------------------------------------------------------------------------------------
// Fitted bins

static const map_case cases[] = {
    {"bumps grow", round_bumps, round_bumps, {0.2, 0.3}, 64, 64, 3, 0.04},
    {"bumps shrink", round_bumps, round_bumps, {0.4, 0.1}, 64, 64, 3, 0.03},
    {"the same", round_bumps, round_bumps, {0.3, 0.3}, 64, 64, 3, 0.01},
    {"one slope becomes bumps", one_slope, round_bumps, {0, 0.3}, 64, 64, 3, 0.01},
    {"bumps become one slope", round_bumps, one_slope, {0.3, 0.2}, 64, 64, 3, 1e-3},
    {"grooves", grooves_along_x, grooves_along_x, {0.5, 0.7}, 100, 80, 3, 0.01},
    {"bumps become grooves", round_bumps, grooves_along_x, {0.3, 0.6}, 64, 64, 3, 0.01},
    {"grooves become facets", grooves_along_x, three_facets, {0.3, 0.6}, 96, 96, 3, 0.01},
    // Several of the first bins are the same, and stay so.
    {"facets become noise", three_facets, noisy_normals, {0.5, 0.6}, 96, 96, 6, 0.7},
    {"one deviates", one_slope, one_deviating, {0, 1}, 64, 64, 2, 0.15},
    {"large", round_bumps, round_bumps, {0.2, 0.4}, 517, 260, 3, 0.03},
    // With few cells, and so few lobes in the sample.
    {"narrow", noisy_normals, round_bumps, {0.2, 0.4}, 671, 3, 3, 0.3},
    {"odd", noisy_normals, noisy_normals, {0.2, 0.4}, 3, 5, 2, 0.26},
    {"two texels", noisy_normals, noisy_normals, {0.2, 0.4}, 1, 2, 2, 0.01},
};
enum { CASES = sizeof cases / sizeof *cases };

static void fits_are_about_those_of_the_host(void **state) {
    const lobe_material materials[] = {
        half_vector_material(LOBE_DISTRIBUTION_VMF, 100),
        microfacet_material(LOBE_DISTRIBUTION_GGX, 0.2, 0),
    };
    for (size_t m = 0; m < sizeof materials / sizeof *materials; m++) {
        for (size_t i = 0; i < CASES; i++) {
            refit r = refit_bins(*state, &cases[i], &materials[m], PARTITION_FITTED);
            check_likelihood(&r, &cases[i], m);
            check_units(&r, &cases[i]);
            lobe_release(r.survey);
        }
    }
}

static void fits_without_first_bins_are_about_those_of_the_host(void **state) {
    const lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.2, 0);
    for (size_t i = 0; i < CASES; i++) {
        refit r = fit_bins(*state, &cases[i], &material, PARTITION_FITTED, false);
        check_likelihood(&r, &cases[i], 0);
        check_units(&r, &cases[i]);
        lobe_release(r.survey);
    }
}

static void the_smoothest_and_the_roughest_are_fitted(void **state) {
    const lobe_material materials[] = {
        microfacet_material(LOBE_DISTRIBUTION_GGX, 0.04, 0),
        microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 0),
        microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.04, 0),
        microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 1, 0),
    };
    for (size_t m = 0; m < sizeof materials / sizeof *materials; m++) {
        refit r = refit_bins(*state, &cases[m], &materials[m], PARTITION_FITTED);
        check_likelihood(&r, &cases[m], m);
        check_units(&r, &cases[m]);
        lobe_release(r.survey);
    }
}

/// The largest sample and the most bins.
static void four_lobes_of_a_texel_are_fitted_to_six_bins(void **state) {
    static const map_case longest = {"noise", noisy_normals, noisy_normals, {0.3, 0.6}, 131, 128, 6,
                                     0};
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 100);
    material.lobe_count = LOBE_MATERIAL_MAXIMUM_LOBES;
    for (uint32_t i = 1; i < material.lobe_count; i++)
        material.lobes[i] =
            (lobe_base_lobe){{i == 1 ? 0.6f : 0, i == 2 ? 0.6f : 0, i == 3 ? 1 : 0.8f},
                             i == 3 ? 5 : 80,
                             {0.2f, 0.2f, 0.2f}};
    refit r = refit_bins(*state, &longest, &material, PARTITION_FITTED);
    check_units(&r, &longest);
    lobe_release(r.survey);
}

/// The result depends on the first bins and the texels alone.
static void refits_are_the_same_in_every_run(void **state) {
    const lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.2, 0);
    struct moment_binning_constants bins;
    for (int run = 0; run < 2; run++) {
        refit r = refit_bins(*state, &cases[8], &material, PARTITION_FITTED);
        if (run == 0)
            bins = r.bins;
        assert_memory_equal(&r.bins, &bins, sizeof bins);
        lobe_release(r.survey);
    }
}

// ---------------------------------------------------------------------------------------------
// Fits that follow others

/// A material whose map changes from frame to frame.
typedef struct following {
    fixture *fixture;
    lobe_scene *scene;
    pass_run run;
    moment_partition first;
    uint32_t width, height;
} following;

static void follow_from(fixture *f, make_normals first, double amount, following *all) {
    const partition_request request = {PARTITION_FITTED, {.bins = 3, .colour = BIN_COLOUR_MEAN}};
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.2, 1);
    *all = (following){.fixture = f, .scene = scene_begin(), .width = 16, .height = 16};
    material.normal_map = scene_add_map(all->scene, first(16, 16, amount));
    scene_end_with_square(all->scene, &material);
    pass_run_begin(&all->run, f, all->scene, "moments", (const char *[]){NULL});
    assert_int_equal(
        passes_moment_partition_make(all->run.scene, 0, &request, &f->host, &all->first), LOBE_OK);
    passes_moment_refit_forget(f->graph, 0);
}

/// Fits the bins to other texels, in a frame.
static struct moment_binning_constants fit_next(following *all, make_normals make, double amount,
                                                bool follows) {
    const lobe_scene_changes changes = {.images = &normals, .image_count = 1};
    const refit_request request = {.follows = follows};
    struct moment_binning_constants result;
    replace_texels(all->scene, normals, make(all->width, all->height, amount));
    assert_int_equal(passes_device_scene_update(all->run.scene, &changes, &all->fixture->host),
                     LOBE_OK);
    const lobe_resource bins = passes_moment_refit(&all->run.context, 0, &all->first, &request);
    lobe_graph_read_back(all->fixture->graph, bins, (lobe_range){0});
    pass_run_execute(&all->run);
    copy_read_back(all->fixture, bins, &result, sizeof result);
    lobe_graph_begin(all->fixture->graph);
    return result;
}

/// What a point lacks of the likelihood of the best fit that the host finds.
static double lack_of(const following *all, const struct moment_binning_constants *bins) {
    refit r = {.first = all->first, .bins = *bins};
    r.survey = passes_lobe_survey_make(all->run.scene, &all->run.scene->materials[0], NULL);
    assert_non_null(r.survey);
    const double lack = (best_likelihood(&r) - likelihood_of(&r)) / (double)r.first.points;
    lobe_release(r.survey);
    return lack;
}

static void stop_following(following *all) {
    pass_run_end(&all->run);
    lobe_scene_destroy(&all->scene);
    assert_int_equal(all->fixture->errors, 0);
}

/// Whether a fit that may follow another is the same as one anew.
static bool begins_anew(following *all, make_normals make, double amount) {
    const struct moment_binning_constants bins = fit_next(all, make, amount, true);
    const struct moment_binning_constants anew = fit_next(all, make, amount, false);
    return memcmp(&bins, &anew, sizeof bins) == 0;
}

static void fits_begin_anew_where_there_is_none_to_follow(void **state) {
    following all;
    follow_from(*state, round_bumps, 0.3, &all);
    assert_true(begins_anew(&all, round_bumps, 0.35));
    // One that follows nothing leaves nothing.
    assert_true(begins_anew(&all, round_bumps, 0.36));
    stop_following(&all);
}

static void fits_begin_anew_where_texels_are_quite_others(void **state) {
    static const struct {
        make_normals make;
        double amount;
        bool anew;
    } ends[] = {{round_bumps, 0.41, false}, {grooves_along_x, 0.9, true}};
    for (size_t n = 0; n < sizeof ends / sizeof *ends; n++) {
        following all;
        follow_from(*state, round_bumps, 0.3, &all);
        for (int i = 1; i <= 3; i++)
            (void)fit_next(&all, round_bumps, 0.38 + 0.01 * i, true);
        assert_true(begins_anew(&all, ends[n].make, ends[n].amount) == ends[n].anew);
        stop_following(&all);
    }
}

/// All first bins are the same, and rounds of improvement alone would leave them so: then a point
/// lacks 0.4.
static void bins_of_a_flat_map_part_as_it_rises(void **state) {
    enum { FRAMES = 150 };
    struct moment_binning_constants bins;
    following all;
    follow_from(*state, one_slope, 0, &all);
    for (int i = 1; i <= FRAMES; i++)
        bins = fit_next(&all, round_bumps, 0.3 * i / FRAMES, true);
    const double lack = lack_of(&all, &bins);
    if (!(lack < 0.15))
        fail_msg("a point lacks %g", lack);
    stop_following(&all);
}

/// The largest distance from a bin's centre to that of the nearest of the others.
static double distance_of(const struct moment_binning_constants *a,
                          const struct moment_binning_constants *b, uint32_t count) {
    double largest = 0;
    for (uint32_t i = 0; i < count; i++) {
        double least = INFINITY;
        for (uint32_t k = 0; k < count; k++)
            least = fmin(least, hypot((double)(a->bins[i].centre[0] - b->bins[k].centre[0]),
                                      (double)(a->bins[i].centre[1] - b->bins[k].centre[1])));
        largest = fmax(largest, least);
    }
    return largest;
}

/// What a still map looks like depends on it alone, not on how it moved before.
static void bins_of_texels_that_rest_become_those_of_a_fit_anew(void **state) {
    enum { MOVING = 20, RESTING = FIT_RESTS_AFTER + 2 * (FITS_OF_SETTLING + 1) };
    struct moment_binning_constants bins, last;
    following all;
    follow_from(*state, cracked_bumps, 0.01, &all);
    for (int i = 1; i <= MOVING + RESTING; i++)
        bins = fit_next(&all, cracked_bumps, fmin(i, MOVING) / 120.0, true);
    last = fit_next(&all, cracked_bumps, MOVING / 120.0, true);
    assert_memory_equal(&last, &bins, sizeof bins);
    const struct moment_binning_constants anew =
        fit_next(&all, cracked_bumps, MOVING / 120.0, false);
    assert_true(bins.largest[2] == 0);
    const double distance = distance_of(&bins, &anew, all.first.bins);
    if (!(distance < 1e-5))
        fail_msg("bins are %g from those of a fit anew", distance);
    stop_following(&all);
}

/// How much of the lobes two fits share among bins in another way.
static double moved_between(const following *all, const struct moment_binning_constants *a,
                            const struct moment_binning_constants *b) {
    const refit first = {.first = all->first, .bins = *a},
                second = {.first = all->first, .bins = *b};
    double members[2][MOMENT_MAXIMUM_BINS], sum = 0, total = 0;
    lobe_survey *survey =
        passes_lobe_survey_make(all->run.scene, &all->run.scene->materials[0], NULL);
    assert_non_null(survey);
    for (uint32_t i = 0; i < survey->count; i++) {
        const plane_sample *sample = &survey->samples[i];
        (void)share(&first, sample, members[0]);
        (void)share(&second, sample, members[1]);
        for (uint32_t k = 0; k < all->first.bins; k++)
            sum += 0.5 * sample->weight * fabs(members[0][k] - members[1][k]);
        total += sample->weight;
    }
    lobe_release(survey);
    return sum / total;
}

/// Where bins become others, lobes change bins little by little: at once, 0.48 of them would.
static void lobes_change_bins_slowly(void **state) {
    enum { FRAMES = 40 };
    struct moment_binning_constants bins = {0}, before;
    double most = 0;
    following all;
    follow_from(*state, cracked_bumps, 0, &all);
    for (int i = 1; i <= FRAMES; i++) {
        before = bins;
        bins = fit_next(&all, cracked_bumps, i / 400.0, true);
        if (i > 1)
            most = fmax(most, moved_between(&all, &before, &bins));
    }
    if (!(most < 0.05))
        fail_msg("%g of the lobes change bins at once", most);
    stop_following(&all);
}

/// Bins that are narrow on their way from one place to another have next to no lobes there: then a
/// point lacks 1.6.
static void bins_that_become_others_serve_the_lobes(void **state) {
    enum { FRAMES = 23 };
    struct moment_binning_constants bins;
    following all;
    follow_from(*state, cracked_bumps, 0, &all);
    for (int i = 1; i <= FRAMES; i++)
        bins = fit_next(&all, cracked_bumps, i / 120.0, true);
    const double lack = lack_of(&all, &bins);
    if (!(lack < 1))
        fail_msg("a point lacks %g", lack);
    stop_following(&all);
}

// ---------------------------------------------------------------------------------------------
// Hats

/// What the host makes of the second texels from the start.
static moment_partition hosts_partition(fixture *f, const map_case *c, const lobe_material *base,
                                        uint32_t kind) {
    map_case second = *c;
    second.first = c->second;
    second.amounts[0] = c->amounts[1];
    refit r = refit_bins(f, &second, base, kind);
    lobe_release(r.survey);
    return r.first;
}

static void check_hats(const refit *r, const map_case *c, const moment_partition *host) {
    const float *found = r->bins.hats, *expected = host->constants.hats;
    const double width = 1 / (double)expected[2];
    for (int axis = 0; axis < 2; axis++)
        if (!(fabs((double)(found[axis] - expected[axis])) < 0.05 * width))
            fail_msg("%s: the middle is %g instead of %g, hats are %g wide", c->name,
                     (double)found[axis], (double)expected[axis], width);
    for (int i = 2; i < 4; i++)
        if (!(fabs((double)(found[i] / expected[i]) - 1) < 0.05))
            fail_msg("%s: width or threshold %g instead of %g", c->name, (double)found[i],
                     (double)expected[i]);
    for (uint32_t k = 0; k < host->bins; k++)
        for (int i = 0; i < 4; i++) {
            assert_true(fabsf(r->bins.bins[k].range[i] - host->constants.bins[k].range[i]) <
                        1e-3f * host->constants.bins[k].range[3]);
            assert_true(fabsf(r->bins.bins[k].shape[i] - host->constants.bins[k].shape[i]) <
                        1e-3f * host->constants.bins[k].shape[3]);
        }
}

static void hats_are_those_of_the_host(void **state) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 100);
    for (int wide = 0; wide < 2; wide++) {
        for (uint32_t kind = PARTITION_HATS; kind <= PARTITION_CAP; kind++) {
            refit r = fit_bins(*state, &cases[0], &material, kind, wide);
            const moment_partition host = hosts_partition(*state, &cases[0], &material, kind);
            check_hats(&r, &cases[0], &host);
            lobe_release(r.survey);
        }
        // Lobes that differ in width.
        material.lobe_count = 2;
        material.lobes[1] = (lobe_base_lobe){{0, 0, 1}, 4, {0.5f, 0.5f, 0.5f}};
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fits_are_about_those_of_the_host),
        cmocka_unit_test(fits_without_first_bins_are_about_those_of_the_host),
        cmocka_unit_test(the_smoothest_and_the_roughest_are_fitted),
        cmocka_unit_test(four_lobes_of_a_texel_are_fitted_to_six_bins),
        cmocka_unit_test(refits_are_the_same_in_every_run),
        cmocka_unit_test(fits_begin_anew_where_there_is_none_to_follow),
        cmocka_unit_test(fits_begin_anew_where_texels_are_quite_others),
        cmocka_unit_test(bins_of_a_flat_map_part_as_it_rises),
        cmocka_unit_test(bins_of_texels_that_rest_become_those_of_a_fit_anew),
        cmocka_unit_test(lobes_change_bins_slowly),
        cmocka_unit_test(bins_that_become_others_serve_the_lobes),
        cmocka_unit_test(hats_are_those_of_the_host),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
