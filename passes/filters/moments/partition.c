#include "passes/filters/moments/partition.h"

#include <math.h>
#include <string.h>

#include "passes/maps/base_maps.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/moment_refit.h"

// ---------------------------------------------------------------------------------------------
// The units of a bin's moments

/// A margin for lobes that are not among the samples. What exceeds it is clipped, if the storage
/// format demands that.
static const double margin = 1.25;

/// Largest products that bring a lobe's membership to its place, variance and sharpness.
typedef struct bin_reach {
    double place, variance, sharpness;
} bin_reach;

/// With membership r and the distance d in units of `place`, both r |d| and r d^2 are at most one.
static void reach_to(const moment_bin *bin, const double place[2], double member,
                     bin_reach *reach) {
    for (int i = 0; i < 2; i++)
        reach->place = fmax(reach->place, sqrt(member) * fabs(place[i] - (double)bin->range[i]));
}

static void reach_widths(const plane_sample *sample, double member, bin_reach *reach) {
    reach->variance = fmax(reach->variance, member * sample->variance);
    // The root of the concentration, which is larger than 1 / sqrt(variance) for GGX.
    double sharpness = sqrt((1 + 2 * sample->variance) / sample->variance);
    reach->sharpness = fmax(reach->sharpness, member * sharpness);
}

static void reach_sample(const plane_sample *sample, const plane_mixture *m,
                         const moment_partition *partition, bin_reach *reaches) {
    double members[MOMENT_MAXIMUM_BINS];
    passes_mixture_share(m, sample, members);
    for (uint32_t k = 0; k < m->count; k++) {
        reach_to(&partition->constants.bins[k], sample->place, members[k], &reaches[k]);
        reach_widths(sample, members[k], &reaches[k]);
    }
}

static void reach_samples(const lobe_survey *survey, const plane_mixture *m,
                          const moment_partition *partition, bin_reach *reaches) {
    for (uint32_t i = 0; i < survey->count; i++)
        reach_sample(&survey->samples[i], m, partition, reaches);
}

static double least_variance(const plane_range *range) {
    return 1 / (range->sharpest * range->sharpest);
}

/// The corners of the range of all places, where samples are rare.
static void reach_corners(const plane_range *range, const plane_mixture *m,
                          const moment_partition *partition, bin_reach *reaches) {
    for (int i = 0; i < 8; i++) {
        const plane_sample corner = {.place = {i & 1 ? range->low[0] : range->high[0],
                                               i & 2 ? range->low[1] : range->high[1]},
                                     .variance = i & 4 ? range->broadest : least_variance(range)};
        reach_sample(&corner, m, partition, reaches);
    }
}

/// What is interpolated between texels of two bins, where no texel need be: a bin without texels
/// there gets it.
static void reach_between(const plane_range *range, const plane_mixture *m,
                          const moment_partition *partition, bin_reach *reaches) {
    const double least = least_variance(range);
    for (uint32_t pair = 0; pair < m->count * m->count; pair++) {
        const double *from = m->components[pair / m->count].mean;
        const double *to = m->components[pair % m->count].mean;
        for (uint32_t i = 0; i < BETWEEN_PLACES; i++) {
            const double part = (i / BETWEEN_WIDTHS + 1) / (double)BETWEEN_STEPS;
            const double width = i % BETWEEN_WIDTHS / (double)(BETWEEN_WIDTHS - 1);
            const plane_sample between = {
                .place = {from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])},
                .variance = least * pow(range->broadest / least, width)};
            reach_sample(&between, m, partition, reaches);
        }
    }
}

/// The origin is the bin's centre, so that the moments of a small bin keep their digits.
static void set_fitted_ranges(const lobe_survey *survey, const plane_mixture *m, bool interpolated,
                              moment_partition *partition) {
    const plane_range *range = &survey->range;
    bin_reach reaches[MOMENT_MAXIMUM_BINS] = {{0}};
    for (uint32_t k = 0; k < m->count; k++)
        for (int i = 0; i < 2; i++)
            partition->constants.bins[k].range[i] = (float)m->components[k].mean[i];
    reach_samples(survey, m, partition, reaches);
    reach_corners(range, m, partition, reaches);
    if (interpolated)
        reach_between(range, m, partition, reaches);
    for (uint32_t k = 0; k < m->count; k++) {
        moment_bin *bin = &partition->constants.bins[k];
        bin->range[2] = (float)fmax(margin * reaches[k].place, 1e-3);
        bin->range[3] = (float)fmin(margin * reaches[k].sharpness, range->sharpest);
        bin->shape[3] = (float)fmin(margin * reaches[k].variance, range->broadest);
    }
}

/// Of any lobes.
static void set_common_ranges(const plane_range *range, moment_partition *partition) {
    for (uint32_t k = 0; k < partition->bins; k++) {
        moment_bin *bin = &partition->constants.bins[k];
        bin->range[2] = 1e-3f; // of maps without any slope; not 0, because it is a divisor
        for (int i = 0; i < 2; i++) {
            bin->range[i] = (float)(0.5 * (range->low[i] + range->high[i]));
            bin->range[2] = fmaxf(bin->range[2], (float)(0.501 * (range->high[i] - range->low[i])));
        }
        bin->range[3] = (float)range->sharpest;
        bin->shape[3] = (float)range->broadest;
    }
}

// ---------------------------------------------------------------------------------------------
// Partitions

static void set_fitted(const lobe_survey *survey, const plane_mixture *m, bool interpolated,
                       moment_partition *partition) {
    partition->bins = m->count;
    for (uint32_t i = 0; i < m->count; i++) {
        const mixture_component *c = &m->components[i];
        struct moment_bin *bin = &partition->constants.bins[i];
        bin->centre[0] = (float)c->mean[0];
        bin->centre[1] = (float)c->mean[1];
        bin->centre[2] = (float)c->offset;
        bin->centre[3] = (float)(0.5 * m->points * (c->inverse[0] + c->inverse[1]));
        for (int k = 0; k < 3; k++)
            bin->shape[k] = (float)(0.5 * m->points * c->inverse[k]);
    }
    if (survey->count > 0)
        set_fitted_ranges(survey, m, interpolated, partition);
    else
        set_common_ranges(&survey->range, partition);
}

/// Hats are two standard deviations of the lobes' places wide. Lobes count as rough if their
/// variance is above the geometric mean of the smallest and the largest, if those differ.
static void set_hats(const lobe_survey *survey, moment_partition *partition) {
    plane_sums sums = {0};
    double least = INFINITY, most = 0;
    for (uint32_t i = 0; i < survey->count; i++) {
        const plane_sample *sample = &survey->samples[i];
        passes_plane_sums_add(&sums, sample, sample->weight);
        least = fmin(least, sample->variance);
        most = fmax(most, sample->variance);
    }
    float *hats = partition->constants.hats;
    for (int i = 0; i < 2; i++)
        hats[i] = (float)(sums.place[i] / fmax(sums.weight, 1e-12));
    double spread = survey->count > 0 ? passes_plane_spread(survey->samples, survey->count) : 0;
    hats[2] = (float)(1 / (2 * sqrt(fmax(spread, 1e-8))));
    hats[3] = most > 1.2 * least ? (float)sqrt(least * most) : 1e9f;
    partition->bins = partition->kind == PARTITION_CAP ? 6 : 5;
    set_common_ranges(&survey->range, partition);
    // Only bin 0 has rough lobes.
    for (uint32_t i = 1; i < partition->bins; i++) {
        float *broadest = &partition->constants.bins[i].shape[3];
        *broadest = fminf(*broadest, hats[3]);
    }
}

static lobe_result set_bins(const device_scene *scene, const device_material *material,
                            const lobe_survey *survey, const partition_request *request,
                            const lobe_allocator *allocator, moment_partition *partition) {
    bin_choice choice;
    if (!passes_bins_choose(scene, material, survey, &request->bins, allocator, &choice))
        return LOBE_ERROR_OUT_OF_MEMORY;
    partition->own_colours = choice.own_colours;
    partition->many_points = choice.many_points;
    partition->points = (float)choice.mixture.points;
    partition->has_first = survey->count > 0;
    if (request->kind == PARTITION_FITTED)
        set_fitted(survey, &choice.mixture, passes_base_maps_are_interpolated(material), partition);
    else
        set_hats(survey, partition);
    return LOBE_OK;
}

lobe_result passes_moment_partition_make(const device_scene *uploaded, uint32_t index,
                                         const partition_request *request, const lobe_host *host,
                                         moment_partition *partition) {
    const device_material *material = &uploaded->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    const lobe_allocator *allocator = lobe_host_allocator(host);
    memset(partition, 0, sizeof *partition);
    partition->kind = request->kind;
    partition->width = grid.width;
    partition->height = grid.height;
    lobe_survey *survey = passes_lobe_survey_make(uploaded, material, allocator);
    if (!survey)
        return LOBE_ERROR_OUT_OF_MEMORY;
    partition->constants.largest[0] = (float)(1.001 * survey->range.heaviest);
    lobe_result result = set_bins(uploaded, material, survey, request, allocator, partition);
    lobe_release(survey);
    return result;
}
