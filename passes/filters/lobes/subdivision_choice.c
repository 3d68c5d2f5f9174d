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

static size_t make_mixture(const material_patch *source, uint32_t subdivision, uint32_t clusters,
                           material_lobe mixture[8]) {
    static const uint32_t clusters_a_lobe[] = {8, 2, 1};
    double sums[8][4] = {{0}};
    for (size_t i = 0; i < source->count; i++) {
        const material_lobe *lobe = &source->lobes[i];
        double *sum = sums[cluster_of(lobe->axis, clusters) / clusters_a_lobe[subdivision]];
        double length = passes_mean_resultant_length(lobe->concentration);
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += lobe->weight * length * lobe->axis[axis];
        sum[3] += lobe->weight;
    }
    size_t count = 0;
    for (uint32_t i = 0; i < 8; i++) {
        double *sum = sums[i];
        double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
        if (length == 0)
            continue;
        material_lobe *lobe = &mixture[count++];
        for (int axis = 0; axis < 3; axis++)
            lobe->axis[axis] = sum[axis] / length;
        lobe->concentration = concentration(length / sum[3]);
        lobe->weight = sum[3];
    }
    return count;
}

static void add_errors(const material_patch *source, uint32_t clusters, double errors[3]) {
    material_lobe mixtures[3][8];
    size_t counts[3];
    for (uint32_t subdivision = 0; subdivision < 3; subdivision++)
        counts[subdivision] = make_mixture(source, subdivision, clusters, mixtures[subdivision]);
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
                                   uint32_t clusters, double tolerance) {
    const lobe_mask mask = passes_lobe_mask(scene, material);
    double errors[3] = {0};
    material_patch source;
    bool any = false;
    for (uint32_t i = 0; i < MATERIAL_PATCHES; i++) {
        if (!passes_material_patch_read(material, &mask, i, &source))
            return 2;
        if (source.count > 0)
            add_errors(&source, clusters, errors);
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
