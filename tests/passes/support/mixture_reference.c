#include "tests/passes/support/mixture_reference.h"

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "shaders/interface/slope_moments.h"
#include "tests/reference/lobe/base_lobe.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/reference/microfacet/slope_distribution.h"
#include "tests/reference/mixture/lobe_mixture.h"

double base_lobe_parameter(const lobe_material *material, uint32_t i, const double width[4]) {
    double parameter =
        material->model == LOBE_MATERIAL_MICROFACET
            ? reference_microfacet_parameter(material->distribution,
                                             (double)material->roughness * width[1])
            : reference_base_lobe_parameter(material->distribution,
                                            (double)material->lobes[i].width * width[0]);
    return reference_convolved_parameter(material->distribution, parameter,
                                         (double)material->normal_concentration);
}

double base_lobe_concentration(const lobe_material *material, uint32_t i, const double width[4]) {
    return reference_base_lobe_concentration(material->distribution,
                                             base_lobe_parameter(material, i, width));
}

static double luminance(const float colour[3]) {
    return 0.2126 * (double)colour[0] + 0.7152 * (double)colour[1] + 0.0722 * (double)colour[2];
}

double base_lobe_share(const lobe_material *material, uint32_t i) {
    if (material->model == LOBE_MATERIAL_MICROFACET)
        return 1;
    double sum = 0;
    for (uint32_t j = 0; j < material->lobe_count; j++)
        sum += luminance(material->lobes[j].colour);
    return luminance(material->lobes[i].colour) / sum;
}

static void turn(double frame[3][3], const double local[3], double result[3]) {
    for (int i = 0; i < 3; i++)
        result[i] = frame[0][i] * local[0] + frame[1][i] * local[1] + frame[2][i] * local[2];
}

/// Adds the lobes of a point of a texel.
static void add_point(const lobe_material *material, const double normal[3], const double width[4],
                      double share, double frame[3][3], const reference_layers *layers, uint32_t x,
                      uint32_t y) {
    double turned[3];
    turn(frame, normal, turned);
    for (int i = 0; i < 3; i++)
        turned[i] *= share;
    reference_add_normal(layers, x, y, turned);
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    for (uint32_t i = 0; i < (microfacet ? 1 : material->lobe_count); i++) {
        reference_lobe lobe = {.concentration = base_lobe_concentration(material, i, width),
                               .share = share * base_lobe_share(material, i)};
        double direction[3] = {0, 0, 1}, axis[3];
        for (int j = 0; j < 3 && !microfacet; j++)
            direction[j] = (double)material->lobes[i].direction[j];
        reference_rotate_from_pole(normal, direction, axis);
        turn(frame, axis, lobe.axis);
        reference_add_lobe(layers, x, y, &lobe);
    }
}

reference_layers allocate_lobe_texels(const lobe_scene *scene, const lobe_material *material,
                                      uint32_t layers) {
    const lobe_image *normals = image_of_map(scene, &material->normal_map);
    const lobe_image *widths = image_of_map(scene, width_map_of(material));
    uint32_t width = normals ? normals->width : 1, height = normals ? normals->height : 1;
    if (widths && widths->width > width)
        width = widths->width;
    if (widths && widths->height > height)
        height = widths->height;
    return reference_layers_allocate(width, height, layers);
}

void read_lobe_point(const lobe_scene *scene, const lobe_material *material,
                     const reference_layers *size, uint32_t x, uint32_t y, const double offset[2],
                     double normal[3], double width[4]) {
    read_surface(scene, material, (x + 0.5 + offset[0]) / size->width,
                 (y + 0.5 + offset[1]) / size->height, normal, width);
}

reference_layers mixture_of_texels(const lobe_scene *scene, const lobe_material *material,
                                   texel_frame frame, const void *user) {
    reference_layers layers = allocate_lobe_texels(scene, material, REFERENCE_MIXTURE_LAYERS);
    const texel_points points = texel_points_of(scene, material);
    for (uint32_t i = 0; i < layers.width * layers.height; i++) {
        uint32_t x = i % layers.width, y = i / layers.width;
        double normal[3], width[4], axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        if (frame && !frame(user, (x + 0.5) / layers.width, (y + 0.5) / layers.height, axes))
            continue;
        for (uint32_t j = 0; j < points.count; j++) {
            read_lobe_point(scene, material, &layers, x, y, points.offsets[j], normal, width);
            add_point(material, normal, width, 1.0 / points.count, axes, &layers, x, y);
        }
    }
    return layers;
}

reference_layers averaged_parameters_of_texels(const lobe_scene *scene,
                                               const lobe_material *material) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    reference_layers layers = allocate_lobe_texels(scene, material, 1);
    const texel_points points = texel_points_of(scene, material);
    for (uint32_t i = 0; i < layers.width * layers.height * points.count; i++) {
        uint32_t texel = i / points.count, x = texel % layers.width, y = texel / layers.width;
        double normal[3], width[4], *parameters = reference_texel(&layers, x, y, 0);
        read_lobe_point(scene, material, &layers, x, y, points.offsets[i % points.count], normal,
                        width);
        for (int j = 0; j < 3; j++)
            parameters[j] += normal[j] / points.count;
        parameters[3] +=
            (microfacet ? base_lobe_concentration(material, 0, width) : width[0]) / points.count;
    }
    return layers;
}

/// Moments of the slopes of one base lobe's direction, and its variance.
static void add_slopes(const double direction[3], double variance, double weight, double *first,
                       double *second) {
    double slope[2];
    reference_slope_of_normal(direction, slope);
    for (int i = 0; i < 2; i++) {
        first[i] += weight * slope[i];
        second[i] += weight * slope[i] * slope[i];
    }
    first[3] += weight * variance;
    second[2] += weight * slope[0] * slope[1];
}

/// Adds the moments of a point of a texel.
static void add_moments(const lobe_material *material, const double normal[3],
                        const double width[4], double share, double *first, double *second) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    first[2] += share * normal[2];
    second[3] += share;
    for (uint32_t i = 0; i < (microfacet ? 1 : material->lobe_count); i++) {
        double local[3] = {0, 0, 1}, axis[3];
        for (int j = 0; j < 3 && !microfacet; j++)
            local[j] = (double)material->lobes[i].direction[j];
        reference_rotate_from_pole(normal, local, axis);
        add_slopes(axis, 1 / fmax(base_lobe_concentration(material, i, width), 1),
                   share * base_lobe_share(material, i), first, second);
    }
}

reference_layers slope_moments_of_texels(const lobe_scene *scene, const lobe_material *material) {
    reference_layers layers = allocate_lobe_texels(scene, material, SLOPE_LAYERS);
    const texel_points points = texel_points_of(scene, material);
    for (uint32_t at = 0; at < layers.width * layers.height * points.count; at++) {
        uint32_t texel = at / points.count, x = texel % layers.width, y = texel / layers.width;
        double normal[3], width[4];
        read_lobe_point(scene, material, &layers, x, y, points.offsets[at % points.count], normal,
                        width);
        add_moments(material, normal, width, 1.0 / points.count,
                    reference_texel(&layers, x, y, SLOPE_LAYER_FIRST),
                    reference_texel(&layers, x, y, SLOPE_LAYER_SECOND));
    }
    return layers;
}

uint32_t mixture_reference_layer(const mixture_map *mixture, uint32_t layer) {
    return mixture->mean_layer != 0 && layer == mixture->mean_layer
               ? (uint32_t)REFERENCE_MIXTURE_LAYER_MEAN
               : layer;
}

static void check_level(const float *texel, const reference_layers *exact, uint32_t level,
                        double tolerance, double rounding) {
    uint32_t count = exact->width * exact->height;
    for (uint32_t i = 0; i < count * exact->layers; i++, texel += 4) {
        uint32_t at = i % count;
        const double *expected =
            reference_texel(exact, at % exact->width, at / exact->width, i / count);
        for (int channel = 0; channel < 4; channel++) {
            double bound = rounding + tolerance * (fabs(expected[channel]) + 0.1);
            if (!(fabs((double)texel[channel] - expected[channel]) <= bound))
                fail_msg("level %u, layer %u, texel %u, channel %d: %.8g instead of %.8g", level,
                         i / count, at, channel, (double)texel[channel], expected[channel]);
        }
    }
}

void check_reduced_levels(const reduced_map *map, const float *texel,
                          const reference_layers *texels, double tolerance, double rounding) {
    reference_layers exact = reference_reduce(texels);
    assert_int_equal(map->width, exact.width);
    assert_int_equal(map->height, exact.height);
    assert_int_equal(map->layers, exact.layers);
    for (uint32_t level = 0; level < map->levels; level++) {
        check_level(texel, &exact, level, tolerance, rounding * (level + 1));
        texel += (size_t)4 * exact.width * exact.height * exact.layers;
        reference_layers next = reference_reduce(&exact);
        reference_layers_free(&exact);
        exact = next;
    }
    reference_layers_free(&exact);
}
