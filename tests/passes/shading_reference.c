#include "tests/passes/shading_reference.h"

#include <math.h>

#include "tests/passes/mixture_reference.h"
#include "tests/reference/base_lobe.h"
#include "tests/reference/dispersion.h"
#include "tests/reference/half_vector_lobe.h"
#include "tests/reference/lobe_mixture.h"
#include "tests/reference/microfacet.h"
#include "tests/reference/vector.h"
#include "tests/reference/von_mises_fisher.h"

void half_between(const double a[3], const double b[3], double half_vector[3]) {
    for (int i = 0; i < 3; i++)
        half_vector[i] = a[i] + b[i];
    reference_normalise(half_vector);
}

static double microfacet_width(const lobe_material *material) {
    return reference_convolved_parameter(
        material->distribution,
        reference_microfacet_parameter(material->distribution, (double)material->roughness),
        (double)material->normal_concentration);
}

/// F D G2 / (4 cos) and Lambert below it; `mean_normal` for the diffuse part's cosine.
static void shade_microfacets(const lobe_material *material, const double normal[3],
                              const double mean_normal[3], double distribution,
                              const double outgoing[3], const double incoming[3],
                              double radiance[3]) {
    double half_vector[3];
    half_between(incoming, outgoing, half_vector);
    double in = reference_dot(normal, incoming), out = reference_dot(normal, outgoing);
    double metallic = (double)material->metallic;
    for (int i = 0; i < 3; i++) {
        double albedo = (double)material->base_colour[i];
        double f0 = 0.04 * (1 - metallic) + albedo * metallic;
        double fresnel = reference_fresnel(f0, 1, reference_dot(incoming, half_vector));
        double shadowing = reference_masking_shadowing(material->distribution, in, out,
                                                       microfacet_width(material));
        radiance[i] = in > 0 && out > 0
                          ? reference_microfacet_specular(fresnel, distribution, shadowing, out) +
                                reference_microfacet_diffuse(albedo * (1 - metallic), fresnel,
                                                             reference_dot(mean_normal, incoming))
                          : 0;
    }
}

static void add_diffuse(const lobe_material *material, const double normal[3],
                        const double incoming[3], double radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] += reference_microfacet_diffuse((double)material->base_colour[i], 0,
                                                    reference_dot(normal, incoming));
}

static double lobe_parameter(const lobe_material *material, uint32_t i) {
    return reference_convolved_parameter(
        material->distribution,
        reference_base_lobe_parameter(material->distribution, (double)material->lobes[i].width),
        (double)material->normal_concentration);
}

static void shade_half_vector_lobes(const lobe_material *material, const double normal[3],
                                    const double half_vector[3], double radiance[3]) {
    for (uint32_t i = 0; i < material->lobe_count; i++) {
        double local[3], axis[3];
        for (int j = 0; j < 3; j++)
            local[j] = (double)material->lobes[i].direction[j];
        reference_rotate_from_pole(normal, local, axis);
        double value = reference_half_vector_lobe(material->distribution, half_vector, axis,
                                                  lobe_parameter(material, i));
        for (int j = 0; j < 3; j++)
            radiance[j] += value * (double)material->lobes[i].colour[j];
    }
}

void shade_base_material(const lobe_material *material, const double normal[3],
                         const double outgoing[3], const double incoming[3], double radiance[3]) {
    radiance[0] = radiance[1] = radiance[2] = 0;
    if (incoming[2] <= 0)
        return;
    double half_vector[3];
    half_between(incoming, outgoing, half_vector);
    if (material->model == LOBE_MATERIAL_MICROFACET) {
        double distribution = reference_normal_distribution(
            material->distribution, normal, half_vector, microfacet_width(material));
        shade_microfacets(material, normal, normal, distribution, outgoing, incoming, radiance);
        return;
    }
    shade_half_vector_lobes(material, normal, half_vector, radiance);
    add_diffuse(material, normal, incoming, radiance);
}

// ---------------------------------------------------------------------------------------------
// Mixtures

/// The shader leaves lighter clusters out.
static const double least_weight = 1e-5;

static double resultant_complement(const double moment[4]) {
    return fmin(fmax(1 - reference_length(moment) / moment[3], 0), 1);
}

/// How far a cluster is to be told apart, [0, 1].
static double refinement(const double moment[4], double base_complement, double epsilon,
                         const refinement_knobs *knobs) {
    if (moment[3] < least_weight)
        return 0;
    double complement = resultant_complement(moment);
    double measure = knobs->dispersion ? 1 / (1 + reference_dispersion(base_complement, complement))
                                       : 1 - complement;
    return 1 - reference_transition(measure, epsilon, knobs->blend);
}

/// The point at which a mixture is evaluated, and what was added up so far.
typedef struct evaluation {
    const reference_layers *mixture;
    uint32_t x, y;
    const double *half_vector;
    double sum;
    unsigned count;
} evaluation;

static const double *moment_of(const evaluation *e, uint32_t layer) {
    return reference_texel(e->mixture, e->x, e->y, layer);
}

static void add_cluster(evaluation *e, uint32_t layer, double share) {
    if (share <= 0 || moment_of(e, layer)[3] < least_weight)
        return;
    e->sum += share * reference_evaluate_cluster(e->mixture, e->x, e->y, layer, e->half_vector);
    e->count++;
}

/// Xu et al. 2017, Algorithm 1.
static void add_clusters(evaluation *e, double base_complement, const refinement_knobs *knobs) {
    double refine = knobs->subdivision == 0 ? 0
                                            : refinement(moment_of(e, REFERENCE_MIXTURE_LAYER_ONE),
                                                         base_complement, knobs->epsilon0, knobs);
    add_cluster(e, REFERENCE_MIXTURE_LAYER_ONE, 1 - refine);
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t sector = REFERENCE_MIXTURE_LAYER_SECTORS + i;
        double refine_half =
            knobs->subdivision < 2
                ? 0
                : refinement(moment_of(e, sector), base_complement, knobs->epsilon1, knobs);
        add_cluster(e, sector, refine * (1 - refine_half));
        for (uint32_t j = 0; j < 2; j++)
            add_cluster(e, REFERENCE_MIXTURE_LAYER_HALVES + 2 * i + j, refine * refine_half);
    }
}

void shade_mixture(const lobe_material *material, const refinement_knobs *knobs,
                   const reference_layers *mixture, uint32_t x, uint32_t y,
                   const double outgoing[3], const double incoming[3], double radiance[3],
                   unsigned *count) {
    double half_vector[3];
    half_between(incoming, outgoing, half_vector);
    evaluation e = {.mixture = mixture, .x = x, .y = y, .half_vector = half_vector};
    double coverage = moment_of(&e, REFERENCE_MIXTURE_LAYER_ONE)[3];
    double mean[4];
    for (int i = 0; i < 4; i++)
        mean[i] = moment_of(&e, REFERENCE_MIXTURE_LAYER_MEAN)[i] / coverage;
    add_clusters(&e, mean[3], knobs);
    if (count)
        *count = e.count;
    double distribution = e.sum / coverage;
    if (material->model == LOBE_MATERIAL_MICROFACET) {
        distribution /= reference_von_mises_fisher_projected_area(
            reference_concentration_from_complement(mean[3]));
        double normal[3] = {mean[0], mean[1], mean[2]};
        reference_normalise(normal);
        shade_microfacets(material, normal, mean, distribution, outgoing, incoming, radiance);
        return;
    }
    for (int i = 0; i < 3; i++) {
        radiance[i] = 0;
        for (uint32_t j = 0; j < material->lobe_count; j++)
            radiance[i] += distribution * (double)material->lobes[j].colour[i];
    }
    add_diffuse(material, mean, incoming, radiance);
}
