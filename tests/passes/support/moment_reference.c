#include "tests/passes/support/moment_reference.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/reference/lobe/base_lobe.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/reference/lobe/lambert_plane.h"
#include "tests/reference/lobe/plane_lobe.h"
#include "tests/reference/microfacet/facing_normals.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/vector.h"

reference_moment_bins moment_bins_of(const moment_partition *partition, double colour_scale) {
    return (reference_moment_bins){
        .kind = partition->kind,
        .bins = partition->bins,
        .colour = partition->own_colours,
        .mirrored = partition->own_colours,
        .many_points = partition->many_points,
        .mass_scale = (double)partition->constants.largest[0],
        .colour_scale = colour_scale,
        .constants = partition->constants,
    };
}

// ---------------------------------------------------------------------------------------------
// Moments

/// At one point: what metal reflects and what is not metal, or the factor of the lobes' colours;
/// and the diffuse colour below them.
static void read_colours(const lobe_scene *scene, const lobe_material *material, double u, double v,
                         const double width[4], double specular[4], double diffuse[4]) {
    reference_map_value(scene, &material->base_colour_map, u, v, diffuse);
    reference_map_value(scene, &material->specular_map, u, v, specular);
    specular[3] = 0;
    for (int i = 0; i < 3; i++) {
        double metallic = (double)material->metallic * width[2];
        diffuse[i] *= (double)material->base_colour[i];
        if (material->model == LOBE_MATERIAL_MICROFACET) {
            specular[i] = diffuse[i] * metallic;
            specular[3] = 1 - metallic;
            diffuse[i] *= (1 - metallic) * (1 - specular[i] - 0.04 * specular[3]);
        }
    }
}

/// The luminance of F0, and a little in any case.
static double mirrored_by(const lobe_material *material, const double colour[4], double unit) {
    const double luminance =
        0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2] + 0.04 * colour[3];
    return material->model == LOBE_MATERIAL_MICROFACET ? 0.02 + 0.98 * luminance / fmax(unit, 1)
                                                       : 1;
}

static reference_plane_lobe lobe_at_point(const lobe_material *material, uint32_t i,
                                          const double normal[3], const double width[4],
                                          const double specular[4], bool as_lobe,
                                          double colour_unit) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    lobe_distribution distribution = as_lobe ? LOBE_DISTRIBUTION_VMF : material->distribution;
    double parameter = as_lobe ? base_lobe_concentration(material, i, width)
                               : base_lobe_parameter(material, i, width);
    double local[3] = {0, 0, 1}, axis[3], share = base_lobe_share(material, i);
    reference_plane_lobe lobe = {.colour = {[3] = specular[3]}};
    for (int j = 0; j < 3; j++) {
        if (!microfacet)
            local[j] = (double)material->lobes[i].direction[j];
        lobe.colour[j] =
            specular[j] * (microfacet ? 1 : (double)material->lobes[i].colour[j] / share);
    }
    lobe.mirrored = mirrored_by(material, lobe.colour, colour_unit);
    reference_rotate_from_pole(normal, local, axis);
    reference_plane_from_direction(axis, lobe.place);
    lobe.variance = reference_plane_variance(distribution, parameter);
    lobe.mass = share * reference_plane_mass(material->model, distribution, parameter);
    return lobe;
}

reference_layers moments_of_texels(const lobe_scene *scene, const lobe_material *material,
                                   const reference_moment_bins *partition, bool as_lobe) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    uint32_t last = reference_moment_layers(partition) - 1;
    reference_layers layers = allocate_lobe_texels(scene, material, last + 1);
    const texel_points points =
        partition->many_points ? many_texel_points() : texel_points_of(scene, material);
    for (uint32_t at = 0; at < layers.width * layers.height * points.count; at++) {
        uint32_t texel = at / points.count, x = texel % layers.width, y = texel / layers.width;
        const double *offset = points.offsets[at % points.count];
        double normal[3], width[4], specular[4], diffuse[4];
        read_lobe_point(scene, material, &layers, x, y, offset, normal, width);
        read_colours(scene, material, (x + 0.5 + offset[0]) / layers.width,
                     (y + 0.5 + offset[1]) / layers.height, width, specular, diffuse);
        for (uint32_t i = 0; i < (microfacet ? 1 : material->lobe_count); i++) {
            reference_plane_lobe lobe = lobe_at_point(material, i, normal, width, specular, as_lobe,
                                                      partition->colour_scale);
            lobe.mass /= points.count;
            reference_add_plane_lobe(partition, &lobe, &layers, x, y);
        }
        // What all texels count, too, which is one without a mask.
        for (int j = 0; partition->colour && j < 4; j++)
            reference_texel(&layers, x, y, last)[j] +=
                (j < 3 ? diffuse[j] / partition->colour_scale : 1) / points.count;
    }
    return layers;
}

// ---------------------------------------------------------------------------------------------
// Shading

/// A bin under the pixel.
typedef struct bin {
    double mass, mean[2], covariance[3]; ///< of the lobes' places
    double sharpness, variance, varies;  ///< of the base lobes: mean, median; of its logarithm
    double halves[2];                    ///< variances of two that have the means, each of half
    bool widths;                         ///< base lobes differ in width
    double mean_variance;
    double base[3]; ///< their covariance at the mean place
    double colour[3];
    double dielectric; ///< the part that is not metal
} bin;

/// Two deviations of equal weight have both means; those of GGX vary log-normally as well,
/// exp(n m + n^2 varies / 2) is the mean of their power n, of which the second is kept where they
/// vary by more than they may.
static void find_widths(bin *b, double mean_variance, lobe_distribution distribution) {
    b->variance = b->halves[0] = b->halves[1] = 1 / (b->sharpness * b->sharpness);
    if (!b->widths)
        return;
    const double ratio = fmax(mean_variance / b->variance, 1);
    // cosh(2 s) cosh(s)^2 = ratio
    double low = 0, high = 6;
    for (int i = 0; i < 60; i++) {
        const double s = 0.5 * (low + high), square = cosh(s) * cosh(s);
        if (cosh(2 * s) * square < ratio)
            low = s;
        else
            high = s;
    }
    const double middle = b->variance * cosh(low) * cosh(low);
    b->halves[0] = middle * exp(-2 * low);
    b->halves[1] = middle * exp(2 * low);
    if (distribution == LOBE_DISTRIBUTION_GGX) {
        b->varies = fmin(log(ratio) / 3, 0.64);
        b->variance *= ratio * exp(-2 * b->varies);
    } else {
        b->variance = middle;
    }
}

static bin read_bin(const lobe_material *material, const reference_moment_bins *partition,
                    const double *moments, uint32_t i) {
    const double *place = moments + 4 * i * (partition->colour ? 3 : 2), *spread = place + 4;
    const struct moment_bin *range = &partition->constants.bins[i];
    bin result = {.mass = place[0] * partition->mass_scale, .dielectric = 1};
    double square = (double)range->range[2] * (double)range->range[2], counts = place[0];
    if (partition->mirrored) {
        const double colour[4] = {partition->colour_scale * place[8] / place[0],
                                  partition->colour_scale * place[9] / place[0],
                                  partition->colour_scale * place[10] / place[0],
                                  place[11] / place[0]};
        counts *= mirrored_by(material, colour, partition->colour_scale);
    }
    for (int j = 0; j < 3; j++) {
        int a = j == 1, b = j != 0;
        result.covariance[j] =
            square * (spread[j] / counts - place[1 + a] * place[1 + b] / (counts * counts));
        if (!partition->colour)
            continue;
        result.colour[j] = place[8 + j] / place[0] * partition->colour_scale;
        result.dielectric = place[11] / place[0];
        if (material->model == LOBE_MATERIAL_MICROFACET)
            result.colour[j] += 0.04 * result.dielectric;
    }
    for (int j = 0; j < 2; j++)
        result.mean[j] = place[1 + j] / counts * (double)range->range[2] + (double)range->range[j];
    result.sharpness = place[3] / counts * (double)range->range[3];
    result.widths = material->metallic_roughness_map.image >= 0 || material->width_map.image >= 0;
    for (uint32_t j = 1; j < material->lobe_count; j++)
        result.widths |= material->lobes[j].width != material->lobes[0].width;
    result.mean_variance = spread[3] / counts * (double)range->shape[3];
    find_widths(&result, result.mean_variance, material->distribution);
    reference_plane_distortion(result.mean, result.base);
    for (int j = 0; j < 3; j++)
        result.base[j] *= result.variance;
    return result;
}

/// Solves C x = d for a covariance (xx, yy, xy); returns the determinant.
static double solve(const double c[3], const double d[2], double x[2]) {
    double determinant = c[0] * c[1] - c[2] * c[2];
    x[0] = (c[1] * d[0] - c[2] * d[1]) / determinant;
    x[1] = (c[0] * d[1] - c[2] * d[0]) / determinant;
    return determinant;
}

/// The sum of Gaussians, and of their inverse covariances with the Gaussians as weights.
typedef struct bell_sum {
    double value, inverse[3];
} bell_sum;

/// Of a Gaussian of the places' covariance and `scale` times the base lobes'.
static void add_bell(const bin *b, double weight, double scale, const double d[2], bell_sum *sum) {
    double covariance[3], x[2];
    for (int i = 0; i < 3; i++)
        covariance[i] = b->covariance[i] + scale * b->base[i];
    double determinant = solve(covariance, d, x);
    double value =
        weight * b->mass / (2 * M_PI * sqrt(determinant)) * exp(-0.5 * (d[0] * x[0] + d[1] * x[1]));
    sum->value += value;
    sum->inverse[0] += value * covariance[1] / determinant;
    sum->inverse[1] += value * covariance[0] / determinant;
    sum->inverse[2] -= value * covariance[2] / determinant;
}

/// Of GGX, Student's tail by four Gaussians; of other lobes, two for the two halves of their
/// widths.
static bell_sum bells(const bin *b, lobe_distribution distribution, const double d[2]) {
    double weights[4], spreads[4];
    bell_sum sum = {0};
    reference_plane_tail(b->varies, weights, spreads);
    for (int i = 0; i < 4 && distribution == LOBE_DISTRIBUTION_GGX; i++)
        add_bell(b, weights[i], spreads[i], d, &sum);
    for (int i = 0; i < 2 && distribution != LOBE_DISTRIBUTION_GGX; i++)
        add_bell(b, 0.5, b->halves[i] / b->variance, d, &sum);
    for (int i = 0; i < 3 && sum.value > 0; i++)
        sum.inverse[i] /= sum.value;
    return sum;
}

static double half_trace(const bin *b) {
    return 0.5 * (b->covariance[0] + b->covariance[1]);
}

/// The base lobes' own shape, as broad as the bin.
static double own_shape(const lobe_material *material, const bin *b, double variance,
                        const double half_vector[3]) {
    lobe_distribution distribution = material->distribution;
    double axis[3];
    double parameter =
        reference_parameter_of_plane_variance(distribution, variance + half_trace(b));
    reference_direction_from_plane(b->mean, axis);
    double shape = material->model == LOBE_MATERIAL_MICROFACET
                       ? reference_normal_distribution(distribution, axis, half_vector, parameter)
                       : reference_half_vector_lobe(distribution, half_vector, axis, parameter);
    return shape * b->mass / reference_plane_mass(material->model, distribution, parameter);
}

/// Places of the texels that reflect: with places and base lobes both Gaussian,
/// mean + C (C + B)^-1 d, and the covariance C - C (C + B)^-1 C.
static void reflecting_places(const bin *b, const double inverse[3], const double d[2],
                              double place[2], double covariance[3]) {
    const double *c = b->covariance, *m = inverse;
    const double gain[2][2] = {{c[0] * m[0] + c[2] * m[2], c[0] * m[2] + c[2] * m[1]},
                               {c[2] * m[0] + c[1] * m[2], c[2] * m[2] + c[1] * m[1]}};
    for (int i = 0; i < 2; i++)
        place[i] = b->mean[i] + gain[i][0] * d[0] + gain[i][1] * d[1];
    covariance[0] = c[0] - gain[0][0] * c[0] - gain[0][1] * c[2];
    covariance[1] = c[1] - gain[1][0] * c[2] - gain[1][1] * c[1];
    covariance[2] = c[2] - gain[1][0] * c[0] - gain[1][1] * c[2];
}

/// GGX by |q|^2 sin^2/|q|^2, sin^2 = |q|^2 (1 - |q|^2 / 4).
static double ggx_beyond_plane(const bin *b, const double place[2], const double covariance[3],
                               const double half_vector[3]) {
    double axis[3], square = covariance[0] + covariance[1], e = 2 * b->variance;
    reference_direction_from_plane(place, axis);
    for (int i = 0; i < 3; i++)
        square += pow(axis[i] - half_vector[i], 2);
    return pow((e + square) / (e + square * (1 - 0.25 * fmin(square, 2))), 2);
}

/// The base lobes' own shape, the more the less the places are spread.
static double with_own_shape(const lobe_material *material, const bin *b, double value,
                             const double half_vector[3]) {
    double own = pow(b->variance / (b->variance + half_trace(b)), 8);
    double shape = 0.5 * (own_shape(material, b, b->halves[0], half_vector) +
                          own_shape(material, b, b->halves[1], half_vector));
    return own * shape + (1 - own) * value;
}

/// The sum over all bins.
typedef struct bin_total {
    double reflected, colour[3]; ///< colours are weighted by what each bin reflects
    double mass, axis[3];
    /// Of microfacets, by how much of a bin is Lambert's: of all, and of those that face the
    /// viewer.
    double diffuse, facing, normal[3], places[2], seconds[3];
} bin_total;

/// Of microfacets, those that face both directions, masked by each other; over 4 <n, omega_o>.
static double masked(const lobe_material *material, const bin *b, double value,
                     reference_normals normals, const double outgoing[3],
                     const double incoming[3]) {
    double share = reference_face(&normals, outgoing);
    share *= reference_face(&normals, incoming);
    double in = fmax(reference_dot(normals.mean, incoming), 0);
    double out = fmax(reference_dot(normals.mean, outgoing), 0);
    double width = reference_parameter_of_plane_variance(material->distribution,
                                                         1 / (b->sharpness * b->sharpness));
    double shadowing = reference_masking_shadowing(material->distribution, in, out, width);
    return reference_microfacet_specular(1, share * value, shadowing, out);
}

static reference_normals normals_at(const double place[2], const double covariance[3]) {
    double seconds[3];
    for (int i = 0; i < 3; i++)
        seconds[i] = covariance[i] + place[i == 1] * place[i != 0];
    return reference_normals_of(place, seconds, 1);
}

/// Lambert's part is as large as the texels, not as their lobes' mass.
static void add_facing(const lobe_material *material, const bin *b, const double axis[3],
                       const double outgoing[3], bin_total *total) {
    const lobe_distribution distribution = material->distribution;
    double parameter = reference_parameter_of_plane_variance(
        distribution, b->widths ? b->mean_variance : b->variance);
    double weight =
        b->dielectric * b->mass / reference_plane_mass(material->model, distribution, parameter);
    reference_normals normals = normals_at(b->mean, b->covariance);
    memcpy(normals.mean, axis, sizeof normals.mean);
    total->diffuse += weight;
    weight *= reference_face(&normals, outgoing);
    total->facing += weight;
    for (int i = 0; i < 3; i++) {
        total->normal[i] += weight * normals.mean[i];
        total->seconds[i] +=
            weight * (normals.covariance[i] + normals.place[i == 1] * normals.place[i != 0]);
    }
    for (int i = 0; i < 2; i++)
        total->places[i] += weight * normals.place[i];
}

static void add_bin(const lobe_material *material, const bin *b, const double half_vector[3],
                    const double outgoing[3], const double incoming[3], bin_total *total) {
    double place[2], axis[3], reflecting[2], covariance[3];
    reference_plane_from_direction(half_vector, place);
    const double d[2] = {place[0] - b->mean[0], place[1] - b->mean[1]};
    bell_sum sum = bells(b, material->distribution, d);
    reflecting_places(b, sum.inverse, d, reflecting, covariance);
    if (material->distribution == LOBE_DISTRIBUTION_GGX)
        sum.value *= ggx_beyond_plane(b, reflecting, covariance, half_vector);
    double value = with_own_shape(material, b, sum.value, half_vector);
    reference_direction_from_plane(b->mean, axis);
    axis[2] -= half_trace(b);
    if (material->model == LOBE_MATERIAL_MICROFACET) {
        value = masked(material, b, value, normals_at(reflecting, covariance), outgoing, incoming);
        add_facing(material, b, axis, outgoing, total);
    }
    total->reflected += value;
    total->mass += b->mass;
    for (int i = 0; i < 3; i++) {
        total->colour[i] += value * b->colour[i];
        total->axis[i] += b->mass * axis[i];
    }
}

/// The mean of normals from that of lobes which turn with them: l the base lobes' mean direction,
/// axis_z = n_z l_z - <n_xy, l_xy>, axis_xy = l_xy + n_xy l_z.
static void mean_normal_of(const lobe_material *material, const bin_total *total,
                           double normal[3]) {
    double local[3] = {0};
    for (int i = 0; i < 3; i++)
        normal[i] = total->axis[i] / total->mass;
    if (material->model == LOBE_MATERIAL_MICROFACET)
        return;
    for (uint32_t i = 0; i < material->lobe_count; i++)
        for (int j = 0; j < 3; j++)
            local[j] += base_lobe_share(material, i) * (double)material->lobes[i].direction[j];
    for (int i = 0; i < 2; i++)
        normal[i] = (normal[i] - local[i]) / local[2];
    normal[2] = (normal[2] + normal[0] * local[0] + normal[1] * local[1]) / local[2];
}

/// Constant colours, where the footprint has its means from no bin.
static void constant_colours(const lobe_material *material, double specular[3], double diffuse[3]) {
    double metallic = (double)material->metallic;
    for (int i = 0; i < 3; i++) {
        double base = (double)material->base_colour[i];
        specular[i] = 0.04 * (1 - metallic) + base * metallic;
        diffuse[i] = base * (1 - metallic);
        if (material->model == LOBE_MATERIAL_MICROFACET)
            continue;
        diffuse[i] = base;
        specular[i] = 0;
        for (uint32_t j = 0; j < material->lobe_count; j++)
            specular[i] += (double)material->lobes[j].colour[i];
    }
}

static void shade_lobes(const bin_total *total, const double specular[3], const double diffuse[3],
                        const double mean[3], const double incoming[3], double radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] = total->reflected * specular[i] +
                      reference_microfacet_diffuse(diffuse[i], 0, reference_dot(mean, incoming));
}

/// `own_colours`: of the bins; then 1 - F0 is part of the diffuse colour.
static void shade_microfacets(const bin_total *total, bool own_colours, const double specular[3],
                              const double diffuse[3], const double half_vector[3],
                              const double incoming[3], double radiance[3]) {
    double lit = 0;
    if (total->facing > 0) {
        reference_normals normals =
            reference_normals_of(total->places, total->seconds, total->facing);
        for (int i = 0; i < 3; i++)
            normals.mean[i] = total->normal[i] / total->facing;
        lit = total->facing / total->diffuse * reference_mean_facing_cosine(&normals, incoming);
    }
    for (int i = 0; i < 3; i++) {
        double cosine = reference_dot(incoming, half_vector);
        double fresnel = reference_fresnel(specular[i], 1, cosine);
        double below = own_colours ? reference_fresnel(0, 1, cosine) : fresnel;
        radiance[i] =
            fresnel * total->reflected + reference_microfacet_diffuse(diffuse[i], below, lit);
    }
}

void shade_moments(const lobe_material *material, const reference_moment_bins *partition,
                   const double *moments, const double outgoing[3], const double incoming[3],
                   double radiance[3]) {
    radiance[0] = radiance[1] = radiance[2] = 0;
    if (incoming[2] <= 0)
        return;
    double half_vector[3], mean[3], specular[3], diffuse[3];
    half_between(incoming, outgoing, half_vector);
    bin_total total = {0};
    for (uint32_t i = 0; i < partition->bins; i++) {
        bin b = read_bin(material, partition, moments, i);
        // As many as the knob least_share leaves.
        if (b.mass > 1e-3)
            add_bin(material, &b, half_vector, outgoing, incoming, &total);
    }
    mean_normal_of(material, &total, mean);
    constant_colours(material, specular, diffuse);
    for (int i = 0; partition->colour && i < 3; i++) {
        specular[i] = total.colour[i] / total.reflected;
        diffuse[i] = moments[4 * (reference_moment_layers(partition) - 1) + (uint32_t)i] *
                     partition->colour_scale;
    }
    if (material->model == LOBE_MATERIAL_MICROFACET)
        shade_microfacets(&total, partition->colour, specular, diffuse, half_vector, incoming,
                          radiance);
    else
        shade_lobes(&total, specular, diffuse, mean, incoming, radiance);
}
