#include "passes/filters/moments/bin_choice.h"

#include <math.h>
#include <string.h>

#include "passes/filters/moments/footprint.h"
#include "passes/maps/colours/lobe_mask.h"
#include "passes/maps/material_patch.h"
#include "passes/upload/material_maps.h"

// A lobe counts as this many points drawn from it: the more points, the harder the borders between
// bins. Hard borders are better for lobes that differ in width, soft ones for lobes that differ in
// direction, because they leave no valleys between bins. All numbers are tried for each material,
// and the best is used. Relative L2 over patches with 1.5, 3 and 10 points: bumps, five bins, 0.21,
// 0.23, 0.24; tablecloth, four bins, 0.07, 0.09, 0.10; rusted metal, three bins, 0.23, 0.13, 0.07.
static const double points[] = {1.5, 3, 10};
enum { POINT_NUMBERS = sizeof points / sizeof *points };

// Where the host cannot read the maps, and so try them.
static const double points_of_unread = 3;

// From this variance of base lobes on, how directions differ hardly shows, and one bin serves.
static const double broad_variance = 0.2;

// A candidate is good enough if its error is at most `tolerance` times the smallest error, or
// `negligible` above it.
static const double tolerance = 1.05, negligible = 0.02;

// An error of the mean diffuse colour counts as much as this much relative L2 of the lobes.
static const double diffuse_weight = 3;

// Below this part of what footprints reflect in the mean, errors count as much as they add to it.
static const double least_colour = 0.1;

enum {
    /// Maximum number of bins chosen automatically: more bins cost more than they improve a pixel.
    MOST = 3,
    /// The last footprint is all of the maps.
    FOOTPRINTS = MATERIAL_PATCHES + 1,
};

// ---------------------------------------------------------------------------------------------
// Footprints

typedef struct footprint_set {
    footprint all[FOOTPRINTS];
    /// That squared errors are divided by.
    double units[FOOTPRINT_LIGHTS][FOOTPRINTS];
    plane_sample lobes[];
} footprint_set;

static void read_patch(const lobe_scene *scene, const device_material *material,
                       const lobe_mask *mask, uint32_t index, footprint *patch) {
    const material_patch_place at = passes_material_patch_place(material, index);
    for (uint32_t i = 0; i < at.columns * at.rows; i++) {
        double point[2];
        passes_material_patch_point(&at, mask, i, point);
        if (passes_lobe_mask_cuts(mask, point))
            continue;
        patch->count += passes_plane_samples_read(scene, material, point[0], point[1], 1,
                                                  &patch->lobes[patch->count]);
    }
}

static uint32_t count_lights(const lobe_survey *survey) {
    for (uint32_t i = 0; i < survey->count; i++)
        if (passes_footprint_is_sharp(survey->samples[i].variance))
            return FOOTPRINT_LIGHTS;
    return 1;
}

/// Errors are relative to each footprint, but for those that are all but black.
static void find_units(const footprint_set *set, uint32_t light, double units[FOOTPRINTS]) {
    double colours[FOOTPRINTS], mean = 0;
    for (uint32_t i = 0; i < FOOTPRINTS; i++) {
        const footprint_light *lit = &set->all[i].lights[light];
        colours[i] = sqrt(lit->square / fmax(lit->whites, 1e-30));
        mean += colours[i] / FOOTPRINTS;
    }
    for (uint32_t i = 0; i < FOOTPRINTS; i++) {
        const double colour = fmax(colours[i], least_colour * mean);
        units[i] = fmax(set->all[i].lights[light].whites * colour * colour, 1e-30);
    }
}

/// The last is of all the maps, and so is a patch that a mask cuts away. NULL: out of memory.
static footprint_set *read_footprints(const device_scene *scene, const device_material *material,
                                      const lobe_survey *survey, const lobe_allocator *allocator) {
    enum { LOBES = MATERIAL_PATCH_EXTENT * MATERIAL_PATCH_EXTENT * LOBE_MATERIAL_MAXIMUM_LOBES };
    const bool microfacet = material->material->model == LOBE_MATERIAL_MICROFACET;
    const uint32_t lights = count_lights(survey);
    const lobe_mask mask = passes_lobe_mask(scene, material);
    footprint_set *set = lobe_allocate(
        allocator, 1,
        sizeof *set + ((size_t)MATERIAL_PATCHES * LOBES + survey->count) * sizeof *set->lobes);
    plane_sample *whole = set ? set->lobes + (size_t)MATERIAL_PATCHES * LOBES : NULL;
    if (set)
        memcpy(whole, survey->samples, survey->count * sizeof *survey->samples);
    for (uint32_t i = 0; set && i < FOOTPRINTS; i++) {
        footprint *patch = &set->all[i];
        patch->lobes = set->lobes + (size_t)i * LOBES;
        patch->log_normal = material->distribution == LOBE_DISTRIBUTION_GGX;
        patch->light_count = lights;
        if (i < MATERIAL_PATCHES)
            read_patch(scene->scene, material, &mask, i, patch);
        if (patch->count == 0) {
            patch->lobes = whole;
            patch->count = survey->count;
        }
        passes_footprint_complete(patch, microfacet);
    }
    for (uint32_t i = 0; set && i < FOOTPRINT_LIGHTS; i++)
        find_units(set, i, set->units[i]);
    return set;
}

// ---------------------------------------------------------------------------------------------
// Candidates

/// A mixture whose bins have the footprint's colour or their own, and for each light the root of
/// its mean squared error over all footprints, each relative L2: a pixel's error counts as much
/// where it is dark. (If errors were summed before that, those of polished patches, where all lobes
/// are sharp and no candidate is good, would outweigh all others.)
typedef struct candidate {
    bin_choice choice;
    double errors[FOOTPRINT_LIGHTS];
} candidate;

static double error_of(const candidate *c) {
    double sum = 0;
    for (uint32_t i = 0; i < FOOTPRINT_LIGHTS; i++)
        sum += c->errors[i];
    return sum;
}

/// Of bins with the footprint's colour and with their own.
static void compare(const footprint_set *set, const plane_mixture *m,
                    double errors[2][FOOTPRINT_LIGHTS]) {
    double squares[2][FOOTPRINT_LIGHTS] = {0}, diffuse = 0;
    const uint32_t lights = set->all[0].light_count;
    for (uint32_t i = 0; i < FOOTPRINTS; i++) {
        footprint_error error[FOOTPRINT_LIGHTS];
        passes_footprint_compare(&set->all[i], m, error);
        for (uint32_t k = 0; k < lights; k++) {
            squares[0][k] += error[k].mean_colour / set->units[k][i] / FOOTPRINTS;
            squares[1][k] += error[k].bin_colours / set->units[k][i] / FOOTPRINTS;
        }
        diffuse += set->all[i].diffuse_error / FOOTPRINTS;
    }
    for (uint32_t k = 0; k < FOOTPRINT_LIGHTS; k++) {
        errors[0][k] = sqrt(squares[0][k]) + diffuse_weight * diffuse;
        errors[1][k] = sqrt(squares[1][k]);
    }
}

/// Whether an earlier start led to about the same likelihood, and so to the same mixture.
static bool is_known(const double *likelihoods, uint32_t start) {
    for (uint32_t i = 0; i < start; i++)
        if (fabs(likelihoods[i] - likelihoods[start]) < 1e-4)
            return true;
    return false;
}

/// Finds the fits of `bins` components with the smallest error, without and with own colours.
static void fit_best(const footprint_set *set, const lobe_survey *survey, uint32_t bins,
                     candidate best[2]) {
    double likelihoods[MIXTURE_STARTS];
    for (uint32_t i = 0; i < (bins > 1 ? POINT_NUMBERS * MIXTURE_STARTS : 1); i++) {
        const uint32_t start = i % MIXTURE_STARTS;
        plane_mixture trial;
        double errors[2][FOOTPRINT_LIGHTS];
        passes_mixture_fit(survey->samples, survey->count, bins, points[i / MIXTURE_STARTS], start,
                           &trial);
        likelihoods[start] = trial.likelihood;
        if (is_known(likelihoods, start))
            continue;
        compare(set, &trial, errors);
        for (int own = 0; own < 2; own++) {
            candidate found = {.choice = {trial, own}};
            memcpy(found.errors, errors[own], sizeof found.errors);
            if (i == 0 || error_of(&found) < error_of(&best[own]))
                best[own] = found;
        }
    }
}

/// Fetches that a pixel needs of bins and colours.
static uint32_t cost_of(const device_material *material, const bin_choice *choice) {
    if (choice->own_colours)
        return 3 * choice->mixture.count + 1;
    return 2 * choice->mixture.count + (material->maps[MAP_BASE_COLOUR].use != NULL) +
           (material->maps[MAP_SPECULAR].use != NULL) + material->metallic_varies;
}

/// The largest error above the least ones, for all lights, in units of what is good enough.
static double excess_of(const candidate *c, const double least[FOOTPRINT_LIGHTS]) {
    double largest = 0;
    for (uint32_t i = 0; i < FOOTPRINT_LIGHTS; i++)
        largest =
            fmax(largest, (c->errors[i] - least[i]) / fmax((tolerance - 1) * least[i], negligible));
    return largest;
}

/// The cheapest of those that are good enough; if none is for all lights, that which lacks least.
static void choose_from(const device_material *material, const candidate *candidates,
                        uint32_t count, bin_choice *choice) {
    double least[FOOTPRINT_LIGHTS] = {INFINITY, INFINITY}, lowest_excess = INFINITY;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < FOOTPRINT_LIGHTS; k++)
            least[k] = fmin(least[k], candidates[i].errors[k]);
    for (uint32_t i = 0; i < count; i++)
        lowest_excess = fmin(lowest_excess, excess_of(&candidates[i], least));
    const candidate *chosen = NULL;
    uint32_t lowest = UINT32_MAX;
    for (uint32_t i = 0; i < count; i++) {
        const candidate *c = &candidates[i];
        const uint32_t cost = cost_of(material, &c->choice);
        if (!(excess_of(c, least) <= fmax(lowest_excess, 1)) || cost > lowest ||
            (cost == lowest && error_of(c) >= error_of(chosen)))
            continue;
        chosen = c;
        lowest = cost;
    }
    // No error is a number if the maps have infinite texels.
    *choice = (chosen ? chosen : &candidates[0])->choice;
}

static void choose(const device_material *material, const footprint_set *set,
                   const lobe_survey *survey, uint32_t bins, bin_colour colour,
                   bin_choice *choice) {
    candidate candidates[2 * MOST];
    uint32_t count = 0;
    for (uint32_t k = bins ? bins : 1; k <= (bins ? bins : MOST); k++) {
        candidate best[2];
        fit_best(set, survey, k, best);
        if (colour != BIN_COLOUR_OWN)
            candidates[count++] = best[0];
        if (colour != BIN_COLOUR_MEAN)
            candidates[count++] = best[1];
    }
    choose_from(material, candidates, count, choice);
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
static bin_choice choose_unread(const device_material *material, uint32_t bins, bin_colour colour) {
    const uint32_t count = has_broad_lobes(material) ? 1 : MOST;
    return (bin_choice){
        .mixture = {.count = bins ? bins : count, .points = points_of_unread},
        .own_colours = colour == BIN_COLOUR_OWN ||
                       (colour == BIN_COLOUR_AUTOMATIC && passes_specular_colour_varies(material))};
}

bool passes_bins_choose(const device_scene *scene, const device_material *material,
                        const lobe_survey *survey, uint32_t bins, bin_colour colour,
                        const lobe_allocator *allocator, bin_choice *choice) {
    *choice = choose_unread(material, bins, colour);
    if (survey->count == 0)
        return true;
    footprint_set *set = read_footprints(scene, material, survey, allocator);
    if (!set)
        return false;
    choose(material, set, survey, bins, colour, choice);
    lobe_release(set);
    return true;
}
