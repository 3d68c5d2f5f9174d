#include "passes/filters/moments/bin_choice.h"

#include <math.h>

#include "passes/filters/moments/footprints/footprint_set.h"
#include "passes/maps/base_maps.h"
#include "passes/upload/material_maps.h"

// A lobe counts as this many points drawn from it: the more points, the harder the borders between
// bins. Hard borders are better for lobes that differ in width, soft ones for lobes that differ in
// direction, because they leave no valleys between bins. All numbers are tried for each material,
// and the best is used. Relative L2 over patches with 1.5, 3 and 10 points: bumps, five bins, 0.21,
// 0.23, 0.24; tablecloth, four bins, 0.07, 0.09, 0.10; rusted metal, three bins, 0.23, 0.13, 0.07.
static const double points[] = {1.5, 3, 10};
enum { POINT_NUMBERS = sizeof points / sizeof *points };

// For maps that the host cannot read, so that nothing can be tried.
static const double points_of_unread = 3;
static const uint32_t bins_of_unread = 3;

// From this variance of base lobes on, how directions differ hardly shows, and one bin serves.
static const double broad_variance = 0.2;

// Where two points a texel make squared errors this much larger than many do, many are read,
// although maps take several times as long to make.
static const double points_gain = 2;

// The squared error that pictures have anyway, as a fetch covers a pixel badly. Errors of bins that
// are smaller hardly show.
static const double unavoidable = 0.0025;

// ---------------------------------------------------------------------------------------------
// Candidates

/// A mixture whose bins have the footprint's colour or their own.
typedef struct candidate {
    bin_choice choice;
    double logarithm; ///< of its squared error, mean over the lights
} candidate;

/// Whether an earlier start led to about the same likelihood, and so to the same mixture.
static bool is_known(const double *likelihoods, uint32_t start) {
    for (uint32_t i = 0; i < start; i++)
        if (fabs(likelihoods[i] - likelihoods[start]) < 1e-4)
            return true;
    return false;
}

/// Logarithms, so that what a broad light shows of sharp lobes counts as much as what a lamp does,
/// under which no bins match them. Of bins with the footprint's colour and with their own.
static void compare(const footprint_set *set, const footprint_lobes *lobes,
                    const plane_mixture *mixture, double logarithms[2]) {
    footprint_error errors[FOOTPRINT_LIGHTS];
    const uint32_t lights = passes_footprint_set_compare(set, lobes, mixture, errors);
    logarithms[0] = logarithms[1] = 0;
    for (uint32_t k = 0; k < lights; k++) {
        logarithms[0] += log(errors[k].mean_colour + unavoidable) / lights;
        logarithms[1] += log(errors[k].bin_colours + unavoidable) / lights;
    }
}

/// Finds the fits of `bins` components with the smallest error, without and with own colours.
static void fit_best(const footprint_set *set, const lobe_survey *survey, uint32_t bins,
                     candidate best[2]) {
    double likelihoods[MIXTURE_STARTS];
    for (uint32_t i = 0; i < (bins > 1 ? POINT_NUMBERS * MIXTURE_STARTS : 1); i++) {
        const uint32_t start = i % MIXTURE_STARTS;
        plane_mixture trial;
        double logarithms[2];
        passes_mixture_fit(survey->samples, survey->count, bins, points[i / MIXTURE_STARTS], start,
                           &trial);
        likelihoods[start] = trial.likelihood;
        if (is_known(likelihoods, start))
            continue;
        compare(set, NULL, &trial, logarithms);
        for (int own = 0; own < 2; own++)
            if (i == 0 || logarithms[own] < best[own].logarithm)
                best[own] = (candidate){.choice = {trial, own}, .logarithm = logarithms[own]};
    }
}

/// Fetches that a pixel needs of bins and colours.
static uint32_t count_fetches(const device_material *material, uint32_t bins, bool own_colours) {
    if (own_colours)
        return 3 * bins + 1;
    return 2 * bins + (material->maps[MAP_BASE_COLOUR].use != NULL) +
           (material->maps[MAP_SPECULAR].use != NULL) + material->metallic_varies;
}

/// The best candidate has the least: the logarithm of its error, plus what its fetches have to take
/// off that to be worth their time.
static double demerit_of(double logarithm, uint32_t fetches, double gain) {
    return logarithm - fetches * log1p(-gain);
}

/// A lower bound for all candidates of this many bins or more.
static double least_demerit(const device_material *material, uint32_t bins, double gain) {
    const uint32_t mean = count_fetches(material, bins, false);
    const uint32_t own = count_fetches(material, bins, true);
    return demerit_of(log(unavoidable), mean < own ? mean : own, gain);
}

static void choose(const device_material *material, const footprint_set *set,
                   const lobe_survey *survey, const bin_request *request, bin_choice *choice) {
    const uint32_t first = request->bins ? request->bins : 1;
    const uint32_t last = request->bins ? request->bins : MOMENT_MAXIMUM_BINS;
    double least = INFINITY;
    bool found = false;
    for (uint32_t k = first;
         k <= last && !(found && least_demerit(material, k, request->gain) >= least); k++) {
        candidate best[2] = {{.logarithm = INFINITY}, {.logarithm = INFINITY}};
        fit_best(set, survey, k, best);
        for (int own = 0; own < 2; own++) {
            if (request->colour == (own ? BIN_COLOUR_MEAN : BIN_COLOUR_OWN))
                continue;
            const double demerit = demerit_of(best[own].logarithm,
                                              count_fetches(material, k, own == 1), request->gain);
            // No error is a number if the maps have infinite texels.
            if (found && !(demerit < least))
                continue;
            *choice = best[own].choice;
            least = fmin(least, demerit);
            found = true;
        }
    }
}

/// Of what is interpolated between texels, passes that build maps read two points a texel. That is
/// enough unless few normals repeat, as in folds of a texel or two. False: out of memory.
static bool choose_points(const device_scene *scene, const device_material *material,
                          const footprint_set *set, const lobe_allocator *allocator,
                          bin_choice *choice) {
    if (!passes_base_maps_are_interpolated(material))
        return true;
    footprint_lobes *lobes = passes_footprint_lobes_read(scene, material, allocator);
    if (!lobes)
        return false;
    double with_two[2], with_all[2];
    compare(set, lobes, &choice->mixture, with_two);
    compare(set, NULL, &choice->mixture, with_all);
    choice->many_points =
        with_two[choice->own_colours] - with_all[choice->own_colours] > log(points_gain);
    lobe_release(lobes);
    return true;
}

/// Whether all texels have the same broad lobe, but for its direction.
static bool has_broad_lobes(const device_material *material) {
    material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES];
    const double up[3] = {0, 0, 1};
    return !material->maps[MAP_WIDTH].use &&
           passes_material_lobes_of(material->material, up, 1, lobes) == 1 &&
           passes_plane_variance(material->material, lobes[0].concentration) >= broad_variance;
}

/// For maps that the host cannot read: what serves most. The device fits the bins.
static bin_choice choose_unread(const device_material *material, const bin_request *request) {
    const uint32_t count = has_broad_lobes(material) ? 1 : bins_of_unread;
    return (bin_choice){
        .mixture = {.count = request->bins ? request->bins : count, .points = points_of_unread},
        .own_colours =
            request->colour == BIN_COLOUR_OWN ||
            (request->colour == BIN_COLOUR_AUTOMATIC && passes_specular_colour_varies(material))};
}

bool passes_bins_choose(const device_scene *scene, const device_material *material,
                        const lobe_survey *survey, const bin_request *request,
                        const lobe_allocator *allocator, bin_choice *choice) {
    *choice = choose_unread(material, request);
    if (survey->count == 0)
        return true;
    footprint_set *set = passes_footprint_set_read(scene, material, survey, allocator);
    if (!set)
        return false;
    choose(material, set, survey, request, choice);
    const bool done = choose_points(scene, material, set, allocator, choice);
    lobe_release(set);
    return done;
}
