#include "passes/subdivision_choice.h"

#include <math.h>
#include <string.h>

#include "passes/image_texel.h"
#include "passes/sample_pattern.h"
#include "shaders/interface/cluster.h"

// A pixel's footprint is of this order where lobes need telling apart; more patches or directions
// than these do not change a choice.
enum { PATCHES = 12, PATCH_EXTENT = 24, DIRECTIONS = 48 };
enum { PATCH_LOBES = PATCH_EXTENT * PATCH_EXTENT * LOBE_MATERIAL_MAXIMUM_LOBES };

// A subdivision is good enough when its error is at most this many times the least, or this much:
// each finer one more than doubles what a pixel costs.
static const double tolerance = 1.5, negligible = 0.03;

typedef struct patch_lobe {
    double axis[3];
    double concentration;
    double weight;
} patch_lobe;

typedef struct patch {
    patch_lobe lobes[PATCH_LOBES];
    size_t count;
} patch;

/// Xu et al. 2017, Eq. 6, as in shaders/lib/von_mises_fisher.glsl.
static double evaluate(const patch_lobe *lobe, const double direction[3]) {
    double kappa = fmax(lobe->concentration, 1e-20), square = 0;
    for (int i = 0; i < 3; ++i)
        square += (direction[i] - lobe->axis[i]) * (direction[i] - lobe->axis[i]);
    return lobe->weight * kappa / (-2 * M_PI * expm1(-2 * kappa)) * exp(-0.5 * kappa * square);
}

static double evaluate_all(const patch_lobe *lobes, size_t count, const double direction[3]) {
    double sum = 0;
    for (size_t i = 0; i < count; ++i)
        sum += evaluate(&lobes[i], direction);
    return sum;
}

/// R(kappa) = coth kappa - 1/kappa.
static double resultant(double kappa) {
    return kappa < 1e-3 ? kappa / 3 : 1 / tanh(kappa) - 1 / kappa;
}

/// Its inverse: Xu et al. 2017, Eq. 8, and Newton's method.
static double concentration(double length) {
    double r = fmin(length, 1 - 1e-7);
    double kappa = r * (3 - r * r) / (1 - r * r);
    for (int i = 0; i < 3 && kappa > 1e-3; ++i) {
        double sinh_kappa = sinh(fmin(kappa, 300));
        kappa -= (resultant(kappa) - r) / (1 / (kappa * kappa) - 1 / (sinh_kappa * sinh_kappa));
    }
    return kappa;
}

/// As rotate_from_pole in shaders/lib/half_vector_lobe.glsl, above the equator.
static void rotate_from_pole(const double normal[3], const double local[3], double result[3]) {
    double product = normal[0] * local[0] + normal[1] * local[1];
    double quotient = product / (1 + fmax(normal[2], -0.999999));
    result[0] = local[0] + normal[0] * (local[2] - quotient);
    result[1] = local[1] + normal[1] * (local[2] - quotient);
    result[2] = normal[2] * local[2] - product;
}

static uint32_t cluster_of(const double axis[3]) {
    bool along_x = fabs(axis[0]) >= fabs(axis[1]);
    uint32_t sector = (along_x ? 0u : 1u) + ((along_x ? axis[0] : axis[1]) < 0 ? 2u : 0u);
    return 2 * sector + (axis[2] < LATITUDE_SPLIT);
}

// ---------------------------------------------------------------------------------------------
// The lobes of a patch

static bool map_texel(const lobe_scene *scene, const device_map *map, uint32_t x, uint32_t y,
                      uint32_t width, uint32_t height, float value[4]) {
    const lobe_image *image = &scene->images[map->use->image].image;
    return image_texel(image, (uint32_t)((uint64_t)x * image->width / width),
                       (uint32_t)((uint64_t)y * image->height / height), value);
}

static bool texel_normal(const lobe_scene *scene, const device_material *material, uint32_t x,
                         uint32_t y, uint32_t width, uint32_t height, double normal[3]) {
    float value[4] = {0.5f, 0.5f, 1, 1};
    const device_map *map = &material->maps[MAP_NORMAL];
    if (map->use && !map_texel(scene, map, x, y, width, height, value))
        return false;
    double scale[3] = {material->material->normal_scale, material->material->normal_scale, 1};
    double square = 0;
    for (int i = 0; i < 3; ++i) {
        normal[i] = (2 * (double)value[i] - 1) * scale[i];
        square += normal[i] * normal[i];
    }
    for (int i = 0; i < 3; ++i)
        normal[i] = square > 0 && isfinite(square) ? normal[i] / sqrt(square) : i == 2;
    return true;
}

/// Concentration of base lobe `i`, as base_concentration in shaders/base_maps.glsl.
static double base_concentration(const lobe_material *material, uint32_t i, double factor) {
    double kappa;
    if (material->model == LOBE_MATERIAL_MICROFACET) {
        double roughness = fmin(fmax(material->roughness * factor, 0), 1);
        double alpha = fmax(roughness * roughness, 1.5e-3);
        kappa = 2 / (alpha * alpha);
    } else {
        kappa = fmax(material->lobes[i].width * factor, 0);
        if (material->distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
            kappa += 1;
    }
    double within = material->normal_concentration;
    return fmin(within > 0 ? kappa * within / (kappa + within) : kappa, 1e6);
}

static bool add_texel(const lobe_scene *scene, const device_material *material, uint32_t x,
                      uint32_t y, uint32_t width, uint32_t height, patch *result) {
    const lobe_material *source = material->material;
    bool microfacet = source->model == LOBE_MATERIAL_MICROFACET;
    double normal[3];
    float widths[4] = {1, 1, 1, 1};
    if (!texel_normal(scene, material, x, y, width, height, normal) ||
        (material->maps[MAP_WIDTH].use &&
         !map_texel(scene, &material->maps[MAP_WIDTH], x, y, width, height, widths)))
        return false;
    for (uint32_t i = 0; i < (microfacet ? 1 : source->lobe_count); ++i) {
        patch_lobe *lobe = &result->lobes[result->count++];
        double pole[3] = {0, 0, 1};
        for (int axis = 0; !microfacet && axis < 3; ++axis)
            pole[axis] = source->lobes[i].direction[axis];
        rotate_from_pole(normal, pole, lobe->axis);
        lobe->concentration = base_concentration(source, i, widths[microfacet ? 1 : 0]);
        lobe->weight = microfacet ? 1 : material_lobe_share(source, i);
    }
    return true;
}

static bool read_patch(const lobe_scene *scene, const device_material *material, uint32_t index,
                       uint32_t width, uint32_t height, patch *result) {
    float corner[2];
    sample_position(index, PATCHES, corner);
    uint32_t columns = width < PATCH_EXTENT ? width : PATCH_EXTENT;
    uint32_t rows = height < PATCH_EXTENT ? height : PATCH_EXTENT;
    uint32_t left = (uint32_t)(corner[0] * (float)(width - columns));
    uint32_t top = (uint32_t)(corner[1] * (float)(height - rows));
    result->count = 0;
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            if (!add_texel(scene, material, left + x, top + y, width, height, result))
                return false;
        }
    }
    for (size_t i = 0; i < result->count; ++i)
        result->lobes[i].weight /= (double)columns * rows;
    return true;
}

// ---------------------------------------------------------------------------------------------
// Mixtures of them, and how far those are off

static size_t make_mixture(const patch *source, uint32_t subdivision, patch_lobe mixture[8]) {
    static const uint32_t clusters_a_lobe[] = {8, 2, 1};
    double sums[8][4] = {{0}};
    for (size_t i = 0; i < source->count; ++i) {
        const patch_lobe *lobe = &source->lobes[i];
        double *sum = sums[cluster_of(lobe->axis) / clusters_a_lobe[subdivision]];
        double length = resultant(lobe->concentration);
        for (int axis = 0; axis < 3; ++axis)
            sum[axis] += lobe->weight * length * lobe->axis[axis];
        sum[3] += lobe->weight;
    }
    size_t count = 0;
    for (uint32_t i = 0; i < 8; ++i) {
        double *sum = sums[i];
        double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
        if (length == 0)
            continue;
        patch_lobe *lobe = &mixture[count++];
        for (int axis = 0; axis < 3; ++axis)
            lobe->axis[axis] = sum[axis] / length;
        lobe->concentration = concentration(length / sum[3]);
        lobe->weight = sum[3];
    }
    return count;
}

/// A direction drawn from one of the patch's lobes: the errors' mean is then one over the truth.
static void draw_direction(const patch *source, uint32_t index, double direction[3]) {
    const patch_lobe *lobe = &source->lobes[index * 7919u % source->count];
    float position[2];
    sample_position(index, DIRECTIONS, position);
    double angle = 2 * M_PI * position[1];
    // Of a narrow lobe, the inverse of its distribution in 1 - cos.
    double versine = fmin(-log1p(-0.999 * position[0]) / fmax(lobe->concentration, 1), 2);
    double sine = sqrt(versine * (2 - versine));
    double local[3] = {sine * cos(angle), sine * sin(angle), 1 - versine};
    rotate_from_pole(lobe->axis, local, direction);
}

static void add_errors(const patch *source, double errors[3]) {
    patch_lobe mixtures[3][8];
    size_t counts[3];
    for (uint32_t subdivision = 0; subdivision < 3; ++subdivision)
        counts[subdivision] = make_mixture(source, subdivision, mixtures[subdivision]);
    for (uint32_t i = 0; i < DIRECTIONS; ++i) {
        double direction[3];
        draw_direction(source, i, direction);
        double truth = evaluate_all(source->lobes, source->count, direction);
        for (int subdivision = 0; truth > 0 && subdivision < 3; ++subdivision) {
            double value = evaluate_all(mixtures[subdivision], counts[subdivision], direction);
            errors[subdivision] += fabs(value - truth) / truth / (PATCHES * DIRECTIONS);
        }
    }
}

uint32_t subdivision_choose(const lobe_scene *scene, const device_material *material) {
    const device_map *normal = &material->maps[MAP_NORMAL], *widths = &material->maps[MAP_WIDTH];
    uint32_t width = normal->width > widths->width ? normal->width : widths->width;
    uint32_t height = normal->height > widths->height ? normal->height : widths->height;
    double errors[3] = {0};
    patch source;
    for (uint32_t i = 0; i < PATCHES; ++i) {
        if (!read_patch(scene, material, i, width, height, &source))
            return 2;
        add_errors(&source, errors);
    }
    double least = fmin(errors[0], fmin(errors[1], errors[2]));
    uint32_t subdivision = 0;
    while (errors[subdivision] > fmax(tolerance * least, negligible))
        ++subdivision;
    return subdivision;
}
