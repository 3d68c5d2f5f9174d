#include "passes/filters/lobes/subdivision_choice.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "passes/filters/lobes/base_widths.h"
#include "passes/filters/lobes/lobe_shapes.h"
#include "shaders/interface/cluster.h"
#include "shaders/interface/mixture.h"

// A subdivision is good enough if its error is at most this many times the least: each finer one
// more than doubles the maps. Four clusters leave a dip between them, in the highlight's middle,
// and are for lobes that lean to their sides.
static const double tolerances[] = {1.2, 1.05, 1};
// Or at most this.
static const double negligible = 0.03;

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
// Clusters

/// What a cluster has.
typedef struct cluster_sum {
    double vector[3];
    double weight;
    double complement; ///< of base lobes, by their weights
} cluster_sum;

/// Clusters of all subdivisions; of each, the children of cluster i are 2i and 2i + 1 of the next,
/// but those of the one are the four.
typedef struct cluster_tree {
    cluster_sum one, sectors[4], halves[8];
} cluster_tree;

static void add_sum(cluster_sum *sum, const cluster_sum *part) {
    for (int axis = 0; axis < 3; axis++)
        sum->vector[axis] += part->vector[axis];
    sum->weight += part->weight;
    sum->complement += part->complement;
}

static cluster_tree sum_clusters(const material_patch *source, uint32_t clusters) {
    cluster_tree tree = {0};
    for (size_t i = 0; i < source->count; i++) {
        const material_lobe *lobe = &source->lobes[i];
        const double complement = passes_lobe_complement(lobe);
        cluster_sum part = {.weight = lobe->weight, .complement = lobe->weight * complement};
        for (int axis = 0; axis < 3; axis++)
            part.vector[axis] = lobe->weight * (1 - complement) * lobe->axis[axis];
        add_sum(&tree.halves[cluster_of(lobe->axis, clusters)], &part);
    }
    for (int i = 0; i < 8; i++)
        add_sum(&tree.sectors[i / 2], &tree.halves[i]);
    for (int i = 0; i < 4; i++)
        add_sum(&tree.one, &tree.sectors[i]);
    return tree;
}

/// What base lobes a cluster has, and how its normals shorten their vectors.
typedef struct cluster_shape {
    double axis[3];
    double complement;                                         ///< 1 - |r|
    double parts[MAXIMUM_WIDTHS], complements[MAXIMUM_WIDTHS]; ///< of lobes about each width
} cluster_shape;

static cluster_shape shape_of(const cluster_sum *sum, const base_widths *widths) {
    const double *vector = sum->vector;
    const double length =
        sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
    const double base = sum->complement / sum->weight;
    cluster_shape shape = {.complement = 1 - length / sum->weight, .parts = {1}};
    for (int axis = 0; axis < 3; axis++)
        shape.axis[axis] = length > 0 ? vector[axis] / length : axis == 2;
    if (widths->count > 1) {
        const double range = widths->complements[1] - widths->complements[0];
        shape.parts[1] = fmin(fmax((base - widths->complements[0]) / range, 0), 1);
        shape.parts[0] = 1 - shape.parts[1];
    }
    const double shortened = fmin((1 - shape.complement) / fmax(1 - base, 1e-3), 1);
    for (uint32_t k = 0; k < widths->count; k++)
        shape.complements[k] =
            widths->count > 1 ? 1 - (1 - widths->complements[k]) * shortened : shape.complement;
    return shape;
}

/// How far a cluster is refined [0, 1], as in shaders/filters/lobes.glsl.
static double refinement(const cluster_sum *sum, const base_widths *widths,
                         const subdivision_request *request, double epsilon) {
    if (!(sum->weight > 0))
        return 0;
    const cluster_shape shape = shape_of(sum, widths);
    double measure = 0;
    for (uint32_t k = 0; k < widths->count; k++) {
        const double base = fmax(widths->complements[k], 1e-6);
        measure += shape.parts[k] / (1 + fmax(shape.complements[k] - base, 0) / base);
    }
    if (request->threshold == THRESHOLD_LENGTH)
        measure = 1 - shape.complement;
    const double place = 0.5 + 0.5 * (measure - epsilon) / fmax(request->blend, 1e-9);
    const double t = fmin(fmax(place, 0), 1);
    return 1 - t * t * (3 - 2 * t);
}

// ---------------------------------------------------------------------------------------------
// Mixtures as they are drawn

/// A cluster's lobe of one width: a von Mises-Fisher lobe and, where they keep it, one of the base
/// lobes' shape.
typedef struct drawn_lobe {
    double axis[3];
    double concentration, weight;
    double own_concentration, own_weight;
} drawn_lobe;

enum { MAXIMUM_LOBES = 13 * MAXIMUM_WIDTHS };

typedef struct drawn_mixture {
    drawn_lobe lobes[MAXIMUM_LOBES];
    size_t count;
} drawn_mixture;

/// As make_lobe in shaders/filters/lobes.glsl.
static drawn_lobe make_lobe(const lobe_material *material, const cluster_shape *shape,
                            uint32_t width, double base, double weight) {
    const double complement = shape->complements[width];
    drawn_lobe lobe = {.concentration = passes_lobe_concentration(1 - complement),
                       .weight = weight};
    memcpy(lobe.axis, shape->axis, sizeof lobe.axis);
    if (passes_lobes_keep_shape(material)) {
        const double own = fmin(base / fmax(complement, 1e-6), 1);
        lobe.own_concentration = lobe.concentration;
        lobe.own_weight = own * weight;
        lobe.weight *= 1 - own;
        if (material->distribution == LOBE_DISTRIBUTION_GGX)
            lobe.concentration /= 1 + GGX_WIDENING * sqrt(own);
    }
    if (material->model == LOBE_MATERIAL_MICROFACET)
        lobe.weight /= passes_lobe_projected_area(passes_lobe_concentration(1 - base));
    return lobe;
}

/// Adds a cluster's lobes, of this share of its weight.
static void add_cluster(const lobe_material *material, const cluster_sum *sum, double share,
                        const base_widths *widths, drawn_mixture *mixture) {
    if (!(share * sum->weight > 0))
        return;
    const cluster_shape shape = shape_of(sum, widths);
    for (uint32_t k = 0; k < widths->count; k++)
        mixture->lobes[mixture->count++] = make_lobe(material, &shape, k, widths->complements[k],
                                                     share * sum->weight * shape.parts[k]);
}

/// Xu et al. 2017, Algorithm 1.
static void make_mixture(const lobe_material *material, const cluster_tree *tree,
                         uint32_t subdivision, const base_widths *widths,
                         const subdivision_request *request, drawn_mixture *mixture) {
    const double root =
        subdivision > 0 ? refinement(&tree->one, widths, request, request->epsilon0) : 0;
    mixture->count = 0;
    add_cluster(material, &tree->one, 1 - root, widths, mixture);
    for (uint32_t i = 0; i < 4; i++) {
        const double half =
            subdivision > 1 ? refinement(&tree->sectors[i], widths, request, request->epsilon1) : 0;
        add_cluster(material, &tree->sectors[i], root * (1 - half), widths, mixture);
        for (uint32_t j = 0; j < 2; j++)
            add_cluster(material, &tree->halves[2 * i + j], root * half, widths, mixture);
    }
}

static double evaluate_mixture(const lobe_material *material, const drawn_mixture *mixture,
                               const double direction[3]) {
    double sum = 0;
    for (size_t i = 0; i < mixture->count; i++) {
        const drawn_lobe *lobe = &mixture->lobes[i];
        sum +=
            lobe->weight * passes_lobe_von_mises_fisher(lobe->axis, lobe->concentration, direction);
        if (lobe->own_weight > 0)
            sum +=
                lobe->own_weight * passes_lobe_of_microfacets(material->distribution, lobe->axis,
                                                              lobe->own_concentration, direction);
    }
    return sum;
}

// ---------------------------------------------------------------------------------------------
// Errors

static double evaluate_patch(const lobe_material *material, const material_patch *source,
                             const double direction[3]) {
    double sum = 0;
    for (size_t i = 0; i < source->count; i++)
        sum +=
            source->lobes[i].weight * passes_lobe_of_base(material, &source->lobes[i], direction);
    return sum;
}

/// A lobe of the patch, each as often as it counts. Neighbours of a map come far apart.
static const material_lobe *draw_lobe(const material_patch *source, uint32_t index) {
    double place = fmod((index + 0.5) * 0.6180339887498949, 1);
    size_t i = 0;
    while (i + 1 < source->count && place >= source->lobes[i].weight)
        place -= source->lobes[i++].weight;
    return &source->lobes[i];
}

/// Adds the root mean square errors of a patch's mixtures, relative to its light, over directions
/// that are drawn in proportion to that: the highlight's middle counts most.
static void add_errors(const lobe_material *material, const material_patch *source,
                       const subdivision_request *request, double errors[3]) {
    const base_widths widths = passes_base_widths(source, request->widths);
    const cluster_tree tree = sum_clusters(source, request->clusters);
    drawn_mixture mixtures[3];
    double squares[3] = {0}, light = 0;
    for (uint32_t k = 0; k < 3; k++)
        make_mixture(material, &tree, k, &widths, request, &mixtures[k]);
    for (uint32_t i = 0; i < MATERIAL_PATCH_DIRECTIONS; i++) {
        float position[2];
        double direction[3];
        passes_sample_position(i, MATERIAL_PATCH_DIRECTIONS, position);
        passes_lobe_draw(material, draw_lobe(source, i), position, direction);
        const double truth = evaluate_patch(material, source, direction);
        light += truth * truth;
        for (int k = 0; truth > 0 && k < 3; k++) {
            const double error = evaluate_mixture(material, &mixtures[k], direction) - truth;
            squares[k] += error * error;
        }
    }
    for (int k = 0; light > 0 && k < 3; k++)
        errors[k] += sqrt(squares[k] / light) / MATERIAL_PATCHES;
}

uint32_t passes_subdivision_choose(const device_scene *scene, const device_material *material,
                                   const subdivision_request *request) {
    const lobe_mask mask = passes_lobe_mask(scene, material);
    double errors[3] = {0};
    material_patch source;
    bool any = false;
    for (uint32_t i = 0; i < MATERIAL_PATCHES; i++) {
        if (!passes_material_patch_read(scene, material, &mask, i, &source))
            return 2;
        if (source.count > 0)
            add_errors(material->material, &source, request, errors);
        any = any || source.count > 0;
    }
    if (!any)
        return 2;
    const double least = fmin(errors[0], fmin(errors[1], errors[2]));
    uint32_t subdivision = 0;
    while (errors[subdivision] > fmax(tolerances[subdivision] * least, negligible))
        ++subdivision;
    return subdivision;
}
