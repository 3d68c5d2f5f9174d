#include "tests/passes/support/shading_reference.h"

#include <math.h>

#include "tests/passes/support/mixture_reference.h"
#include "tests/reference/lobe/base_lobe.h"
#include "tests/reference/lobe/dispersion.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/mixture/lobe_mixture.h"
#include "tests/reference/vector.h"

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

static double fresnel_of(const lobe_material *material, int channel, const double incoming[3],
                         const double half_vector[3]) {
    double metallic = (double)material->metallic;
    double f0 = 0.04 * (1 - metallic) + (double)material->base_colour[channel] * metallic;
    return reference_fresnel(f0, 1, reference_dot(incoming, half_vector));
}

/// D G2 / (4 cos), about one normal.
static double microfacet_geometry(const lobe_material *material, const double normal[3],
                                  const double outgoing[3], const double incoming[3],
                                  double distribution) {
    double in = reference_dot(normal, incoming), out = reference_dot(normal, outgoing);
    if (in <= 0 || out <= 0)
        return 0;
    return reference_microfacet_specular(
        1, distribution,
        reference_masking_shadowing(material->distribution, in, out, microfacet_width(material)),
        out);
}

/// Lambert below whatever the specular part leaves; `normal` may be shorter than one.
static void add_diffuse(const lobe_material *material, const double normal[3],
                        const double half_vector[3], const double incoming[3], double radiance[3]) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    for (int i = 0; i < 3; i++) {
        double albedo = (double)material->base_colour[i];
        double fresnel = 0;
        if (microfacet) {
            albedo *= 1 - (double)material->metallic;
            fresnel = fresnel_of(material, i, incoming, half_vector);
        }
        radiance[i] +=
            reference_microfacet_diffuse(albedo, fresnel, reference_dot(normal, incoming));
    }
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
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    if (microfacet &&
        (reference_dot(normal, incoming) <= 0 || reference_dot(normal, outgoing) <= 0))
        return;
    if (microfacet) {
        double distribution = reference_normal_distribution(
            material->distribution, normal, half_vector, microfacet_width(material));
        double value = microfacet_geometry(material, normal, outgoing, incoming, distribution);
        for (int i = 0; i < 3; i++)
            radiance[i] = value * fresnel_of(material, i, incoming, half_vector);
    } else {
        shade_half_vector_lobes(material, normal, half_vector, radiance);
    }
    add_diffuse(material, normal, half_vector, incoming, radiance);
}

// ---------------------------------------------------------------------------------------------
// Mixtures

/// Clusters below this weight are not separated, and lobes below it not counted.
static const double least_weight = 1e-5;

static double resultant_complement(const double moment[4]) {
    return fmin(fmax(1 - reference_length(moment) / moment[3], 0), 1);
}

/// How far a cluster is to be separated, [0, 1].
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
    const lobe_material *material;
    const reference_layers *mixture;
    uint32_t x, y;
    double half_vector[3];
    double base_complement; ///< mean 1 - |r| of the base lobes
    double sum;
    unsigned count;
} evaluation;

static const double *moment_of(const evaluation *e, uint32_t layer) {
    return reference_texel(e->mixture, e->x, e->y, layer);
}

/// The base lobe of a concentration, and of the material's kind.
static double parameter_of(lobe_distribution distribution, double concentration) {
    switch (distribution) {
    case LOBE_DISTRIBUTION_BLINN_PHONG:
        return fmax(concentration - 1, 0);
    case LOBE_DISTRIBUTION_VMF:
        return concentration;
    default:
        return sqrt(2 / concentration);
    }
}

/// Of a cluster of microfacets, as a distribution of projected area one: von Mises-Fisher as far as
/// the normals are spread, of the base lobes' own shape as far as those are. Beside GGX, the former
/// is broader than the whole (shaders/filters/lobes.glsl).
static double evaluate_microfacet_cluster(const evaluation *e, uint32_t layer) {
    const double *moment = moment_of(e, layer);
    lobe_distribution distribution = e->material->distribution;
    double complement = fmax(resultant_complement(moment), 1e-6);
    double own =
        distribution == LOBE_DISTRIBUTION_VMF ? 0 : fmin(e->base_complement / complement, 1);
    // A mean of base lobes, each of which has this projected area above its own horizon.
    double area = reference_von_mises_fisher_projected_area(
        reference_concentration_from_complement(e->base_complement));
    double kappa = reference_concentration_from_complement(complement);
    double length = reference_length(moment);
    const double axis[3] = {moment[0] / length, moment[1] / length, moment[2] / length};
    double widening = distribution == LOBE_DISTRIBUTION_GGX ? 1 + 0.56 * sqrt(own) : 1;
    double spread = reference_von_mises_fisher(e->half_vector, axis, kappa / widening) / area;
    double base = reference_normal_distribution(distribution, axis, e->half_vector,
                                                parameter_of(distribution, kappa));
    return moment[3] * ((1 - own) * spread + own * base);
}

static void add_cluster(evaluation *e, uint32_t layer, double share) {
    double weight = moment_of(e, layer)[3];
    if (share <= 0 || weight <= 0)
        return;
    bool microfacet = e->material->model == LOBE_MATERIAL_MICROFACET;
    e->sum += share * (microfacet ? evaluate_microfacet_cluster(e, layer)
                                  : reference_evaluate_cluster(e->mixture, e->x, e->y, layer,
                                                               e->half_vector));
    e->count += share * weight > least_weight;
}

/// Xu et al. 2017, Algorithm 1.
static void add_clusters(evaluation *e, const refinement_knobs *knobs) {
    double refine = knobs->subdivision == 0
                        ? 0
                        : refinement(moment_of(e, REFERENCE_MIXTURE_LAYER_ONE), e->base_complement,
                                     knobs->epsilon0, knobs);
    add_cluster(e, REFERENCE_MIXTURE_LAYER_ONE, 1 - refine);
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t sector = REFERENCE_MIXTURE_LAYER_SECTORS + i;
        double refine_half =
            knobs->subdivision < 2
                ? 0
                : refinement(moment_of(e, sector), e->base_complement, knobs->epsilon1, knobs);
        add_cluster(e, sector, refine * (1 - refine_half));
        for (uint32_t j = 0; j < 2; j++)
            add_cluster(e, REFERENCE_MIXTURE_LAYER_HALVES + 2 * i + j, refine * refine_half);
    }
}

/// The mean normal of the texels that reflect about the half vector: between the mean normal and
/// the half vector, by the part of the lobes' breadth that is the normals' own, less of it in the
/// tails of GGX. `mean`: of the normals, and of 1 - |r| (shaders/filters/lobes.glsl).
static void reflecting_normal(const lobe_material *material, const double mean[4],
                              const double half_vector[3], double normal[3]) {
    double length = reference_length(mean), square = 0;
    double breadth = 1 - (1 - mean[3]) * length;
    for (int i = 0; i < 3; i++)
        square += pow(mean[i] / length - half_vector[i], 2);
    if (material->distribution != LOBE_DISTRIBUTION_GGX)
        square = 0;
    double spread = (breadth - mean[3]) / fmax(breadth, 0.25 * square);
    for (int i = 0; i < 3; i++)
        normal[i] = (1 - spread) * mean[i] / length + spread * half_vector[i];
    reference_normalise(normal);
}

static void shade_mixture_of_microfacets(const evaluation *e, const double mean[4],
                                         double distribution, const double outgoing[3],
                                         const double incoming[3], double radiance[3]) {
    double normal[3];
    reflecting_normal(e->material, mean, e->half_vector, normal);
    if (reference_dot(normal, incoming) <= 0 || reference_dot(normal, outgoing) <= 0)
        return;
    double value = microfacet_geometry(e->material, normal, outgoing, incoming, distribution);
    for (int i = 0; i < 3; i++)
        radiance[i] = value * fresnel_of(e->material, i, incoming, e->half_vector);
    add_diffuse(e->material, mean, e->half_vector, incoming, radiance);
}

void shade_mixture(const lobe_material *material, const refinement_knobs *knobs,
                   const reference_layers *mixture, uint32_t x, uint32_t y,
                   const double outgoing[3], const double incoming[3], double radiance[3],
                   unsigned *count) {
    evaluation e = {.material = material, .mixture = mixture, .x = x, .y = y};
    half_between(incoming, outgoing, e.half_vector);
    double coverage = moment_of(&e, REFERENCE_MIXTURE_LAYER_ONE)[3];
    double mean[4];
    for (int i = 0; i < 4; i++)
        mean[i] = moment_of(&e, REFERENCE_MIXTURE_LAYER_MEAN)[i] / coverage;
    e.base_complement = mean[3];
    add_clusters(&e, knobs);
    if (count)
        *count = e.count;
    radiance[0] = radiance[1] = radiance[2] = 0;
    double distribution = e.sum / coverage;
    if (material->model == LOBE_MATERIAL_MICROFACET) {
        shade_mixture_of_microfacets(&e, mean, distribution, outgoing, incoming, radiance);
        return;
    }
    for (uint32_t i = 0; i < material->lobe_count; i++)
        for (int j = 0; j < 3; j++)
            radiance[j] += distribution * (double)material->lobes[i].colour[j];
    add_diffuse(material, mean, e.half_vector, incoming, radiance);
}
