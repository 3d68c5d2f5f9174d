#include "passes/filters/lobes/subdivision_choice.h"

#include <math.h>
#include <string.h>

#include "passes/maps/material_patch.h"
#include "shaders/interface/cluster.h"

// A subdivision is good enough if its error is at most this, too: each finer one more than doubles
// the maps.
static const double negligible = 0.03;

/// The inverse of mean_resultant_length: Xu et al. 2017, Eq. 8, and Newton's method.
static double concentration(double length) {
    double r = fmin(length, 1 - 1e-7);
    double kappa = r * (3 - r * r) / (1 - r * r);
    for (int i = 0; i < 3 && kappa > 1e-3; i++) {
        double sinh_kappa = sinh(fmin(kappa, 300));
        kappa -= (passes_mean_resultant_length(kappa) - r) /
                 (1 / (kappa * kappa) - 1 / (sinh_kappa * sinh_kappa));
    }
    return kappa;
}

static uint32_t cluster_of(const double axis[3], uint32_t clusters) {
    if (clusters == CLUSTERS_PAPER) {
        uint32_t quadrant = axis[1] < 0 ? (axis[0] < 0 ? 2u : 3u) : (axis[0] < 0 ? 1u : 0u);
        return 2 * quadrant + (axis[2] < LATITUDE_SPLIT_PAPER);
    }
    bool along_x = fabs(axis[0]) >= fabs(axis[1]);
    uint32_t sector = (along_x ? 0u : 1u) + ((along_x ? axis[0] : axis[1]) < 0 ? 2u : 0u);
    return 2 * sector + (axis[2] < LATITUDE_SPLIT);
}

// ---------------------------------------------------------------------------------------------
// Mixtures and their errors

enum { MAXIMUM_WIDTHS = 2, MAXIMUM_LOBES = 8 * MAXIMUM_WIDTHS };

/// Base lobes that stand for those of a patch: as in shaders/lib/lobe/width_pair.glsl.
typedef struct base_widths {
    uint32_t count;
    double complements[MAXIMUM_WIDTHS]; ///< 1 - |r|
    double parts[MAXIMUM_WIDTHS];
} base_widths;

static double complement_of(const material_lobe *lobe) {
    return 1 - passes_mean_resultant_length(lobe->concentration);
}

static base_widths widths_of(const material_patch *source, uint32_t count) {
    double powers[3] = {0};
    for (size_t i = 0; i < source->count && count > 1; i++) {
        const double u = 1 + 0.2 * log(fmax(complement_of(&source->lobes[i]), 1e-6));
        for (int j = 0; j < 3; j++)
            powers[j] += source->lobes[i].weight * pow(u, j + 1);
    }
    const double mean = powers[0], variance = powers[1] - mean * mean;
    if (!(variance > 1e-6))
        return (base_widths){.count = 1};
    const double deviation = sqrt(variance);
    const double skewness =
        (powers[2] - mean * (3 * variance + mean * mean)) / (variance * deviation);
    const double root = sqrt(skewness * skewness + 4);
    base_widths widths = {.count = 2};
    for (int k = 0; k < 2; k++) {
        const double u = mean + 0.5 * deviation * (skewness + (k == 0 ? -root : root));
        widths.complements[k] = fmin(exp(5 * (u - 1)), 1);
        widths.parts[k] = 0.5 + (k == 0 ? 0.5 : -0.5) * skewness / root;
    }
    return widths;
}

/// What a cluster has.
typedef struct cluster_sum {
    double vector[3];
    double weight;
    double complement; ///< of base lobes, by their weights
} cluster_sum;

/// Adds the cluster's lobes of each width; returns their number.
static size_t add_cluster(const cluster_sum *sum, const base_widths *widths,
                          material_lobe *mixture) {
    const double *vector = sum->vector;
    const double length =
        sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
    if (length == 0)
        return 0;
    const double base = sum->complement / sum->weight;
    const double range = widths->complements[1] - widths->complements[0];
    const double broad =
        widths->count > 1 ? fmin(fmax((base - widths->complements[0]) / range, 0), 1) : 0;
    for (uint32_t k = 0; k < widths->count; k++) {
        double resultant = length / sum->weight;
        if (widths->count > 1)
            resultant = (1 - widths->complements[k]) * fmin(resultant / (1 - base), 1);
        mixture[k] = (material_lobe){.concentration = concentration(resultant),
                                     .weight = sum->weight * (k == 0 ? 1 - broad : broad)};
        for (int axis = 0; axis < 3; axis++)
            mixture[k].axis[axis] = vector[axis] / length;
    }
    return widths->count;
}

static size_t make_mixture(const material_patch *source, uint32_t subdivision, uint32_t clusters,
                           const base_widths *widths, material_lobe mixture[MAXIMUM_LOBES]) {
    static const uint32_t clusters_a_lobe[] = {8, 2, 1};
    cluster_sum sums[8] = {0};
    for (size_t i = 0; i < source->count; i++) {
        const material_lobe *lobe = &source->lobes[i];
        cluster_sum *sum = &sums[cluster_of(lobe->axis, clusters) / clusters_a_lobe[subdivision]];
        double complement = complement_of(lobe);
        for (int axis = 0; axis < 3; axis++)
            sum->vector[axis] += lobe->weight * (1 - complement) * lobe->axis[axis];
        sum->weight += lobe->weight;
        sum->complement += lobe->weight * complement;
    }
    size_t count = 0;
    for (uint32_t i = 0; i < 8; i++)
        count += add_cluster(&sums[i], widths, &mixture[count]);
    return count;
}

static void add_errors(const material_patch *source, uint32_t clusters, uint32_t width_count,
                       double errors[3]) {
    const base_widths widths = widths_of(source, width_count);
    material_lobe mixtures[3][MAXIMUM_LOBES];
    size_t counts[3];
    for (uint32_t subdivision = 0; subdivision < 3; subdivision++)
        counts[subdivision] =
            make_mixture(source, subdivision, clusters, &widths, mixtures[subdivision]);
    for (uint32_t i = 0; i < MATERIAL_PATCH_DIRECTIONS; i++) {
        double direction[3];
        passes_material_patch_draw(source, i, direction);
        double truth = passes_material_patch_evaluate(source, direction);
        for (int subdivision = 0; truth > 0 && subdivision < 3; subdivision++) {
            double value = passes_material_lobes_evaluate(mixtures[subdivision],
                                                          counts[subdivision], direction);
            errors[subdivision] +=
                fabs(value - truth) / truth / (MATERIAL_PATCHES * MATERIAL_PATCH_DIRECTIONS);
        }
    }
}

uint32_t passes_subdivision_choose(const device_scene *scene, const device_material *material,
                                   uint32_t clusters, uint32_t widths, double tolerance) {
    const lobe_mask mask = passes_lobe_mask(scene, material);
    double errors[3] = {0};
    material_patch source;
    bool any = false;
    for (uint32_t i = 0; i < MATERIAL_PATCHES; i++) {
        if (!passes_material_patch_read(material, &mask, i, &source))
            return 2;
        if (source.count > 0)
            add_errors(&source, clusters, widths, errors);
        any = any || source.count > 0;
    }
    if (!any)
        return 2;
    double least = fmin(errors[0], fmin(errors[1], errors[2]));
    uint32_t subdivision = 0;
    while (errors[subdivision] > fmax(tolerance * least, negligible))
        ++subdivision;
    return subdivision;
}
