#include "passes/filters/moments/partition.h"

#include <math.h>
#include <string.h>

#include "passes/filters/moments/bin_choice.h"
#include "passes/upload/material_maps.h"

static void set_range(const plane_range *found, moment_range *range) {
    range->place[2] = 1e-3f; // of maps without any slope; not 0, because it is a divisor
    const double rounding = 1.001;
    for (int i = 0; i < 2; i++) {
        range->place[i] = (float)(0.5 * (found->low[i] + found->high[i]));
        float half = (float)(0.5 * rounding * (found->high[i] - found->low[i]));
        range->place[2] = fmaxf(range->place[2], half);
    }
    range->largest[0] = (float)(rounding * found->heaviest);
    range->largest[1] = (float)(rounding * found->sharpest);
}

static void set_fitted(const plane_mixture *m, moment_partition *partition) {
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
}

static lobe_result set_bins(const lobe_scene *scene, const device_material *material,
                            const lobe_survey *survey, uint32_t bins,
                            const lobe_allocator *allocator, moment_partition *partition) {
    plane_mixture fitted;
    if (partition->kind != PARTITION_FITTED)
        set_hats(survey, partition);
    else if (passes_bins_choose(scene, material, survey, bins, allocator, &fitted))
        set_fitted(&fitted, partition);
    else
        return LOBE_ERROR_OUT_OF_MEMORY;
    return LOBE_OK;
}

lobe_result passes_moment_partition_make(const device_scene *uploaded, uint32_t index,
                                         uint32_t kind, uint32_t bins, const lobe_host *host,
                                         moment_partition *partition) {
    const device_material *material = &uploaded->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    const lobe_allocator *allocator = lobe_host_allocator(host);
    memset(partition, 0, sizeof *partition);
    partition->kind = kind;
    partition->width = grid.width;
    partition->height = grid.height;
    lobe_survey *survey = passes_lobe_survey_make(uploaded->scene, material, allocator);
    if (!survey)
        return LOBE_ERROR_OUT_OF_MEMORY;
    set_range(&survey->range, &partition->constants.range);
    lobe_result result = set_bins(uploaded->scene, material, survey, bins, allocator, partition);
    lobe_release(survey);
    return result;
}
