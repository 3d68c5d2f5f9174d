#include "passes/upload/material_lobes.h"

#include <math.h>
#include <string.h>

#include <lobe/colour.h>

#include "passes/upload/material_maps.h"

double passes_mean_resultant_length(double kappa) {
    // For small kappa the difference cancels; the first term of its series does not.
    return kappa < 1e-3 ? kappa / 3 : 1 / tanh(kappa) - 1 / kappa;
}

float passes_material_lobe_share(const lobe_material *material, uint32_t lobe) {
    float sum = 0;
    for (uint32_t i = 0; i < material->lobe_count; i++)
        sum += lobe_luminance(material->lobes[i].colour);
    return sum > 0 ? lobe_luminance(material->lobes[lobe].colour) / sum
                   : 1.0f / (float)material->lobe_count;
}

uint32_t passes_wrapped_texel(int64_t i, uint32_t size, lobe_scene_wrap wrap) {
    if (wrap == LOBE_SCENE_WRAP_CLAMP)
        return (uint32_t)(i < 0 ? 0 : i >= size ? size - 1 : i);
    int64_t period = wrap == LOBE_SCENE_WRAP_MIRROR ? 2 * (int64_t)size : size;
    int64_t place = (i % period + period) % period;
    return (uint32_t)(place < size ? place : period - 1 - place);
}

/// Adds one texel with a weight to the values.
static bool add_texel(const lobe_image *image, const lobe_texture_use *use, int64_t x, int64_t y,
                      double weight, double value[4]) {
    float texel[4];
    if (!passes_image_texel(image, passes_wrapped_texel(x, image->width, use->wrap_u),
                            passes_wrapped_texel(y, image->height, use->wrap_v), texel))
        return false;
    for (int i = 0; i < 4; i++)
        value[i] += weight * (double)texel[i];
    return true;
}

/// A map's value at texture coordinates, as its sampler gives it.
static bool sample_map(const device_map *map, double u, double v, double value[4]) {
    const lobe_image *image = map->texels;
    double x = u * image->width, y = v * image->height;
    memset(value, 0, 4 * sizeof *value);
    if (map->use->nearest)
        return add_texel(image, map->use, (int64_t)floor(x), (int64_t)floor(y), 1, value);
    double left = floor(x - 0.5), top = floor(y - 0.5);
    double right_part = x - 0.5 - left, lower_part = y - 0.5 - top;
    for (int i = 0; i < 4; i++) {
        double weight =
            (i & 1 ? right_part : 1 - right_part) * (i & 2 ? lower_part : 1 - lower_part);
        if (!add_texel(image, map->use, (int64_t)left + (i & 1), (int64_t)top + (i >> 1), weight,
                       value))
            return false;
    }
    return true;
}

/// As stored_normal in shaders/lib/map/normal_map.glsl.
static void decode_normal(lobe_normal_encoding encoding, const double value[4], double normal[3]) {
    for (int i = 0; i < 3; i++)
        normal[i] = passes_normals_are_signed(encoding) ? value[i] : 2 * value[i] - 1;
    if (passes_normals_lack_z(encoding))
        normal[2] = sqrt(fmax(0, 1 - normal[0] * normal[0] - normal[1] * normal[1]));
}

/// Unit.
static bool sample_normal(const device_material *material, double u, double v, double normal[3]) {
    double value[4] = {0.5, 0.5, 1, 1};
    const device_map *map = &material->maps[MAP_NORMAL];
    if (map->use && !sample_map(map, u, v, value))
        return false;
    double scale[3] = {(double)material->material->normal_scale,
                       (double)material->material->normal_scale, 1};
    double square = 0;
    decode_normal(map->normals, value, normal);
    for (int i = 0; i < 3; i++) {
        normal[i] *= scale[i];
        square += normal[i] * normal[i];
    }
    for (int i = 0; i < 3; i++)
        normal[i] = square > 0 && isfinite(square) ? normal[i] / sqrt(square) : i == 2;
    return true;
}

/// As convolved_parameter in shaders/lib/lobe/base_lobe.glsl, with Xu et al. 2017, Eq. 8.
static double convolved(lobe_distribution distribution, double kappa, double within) {
    if (distribution != LOBE_DISTRIBUTION_VMF)
        return kappa * within / (kappa + within);
    double r = passes_mean_resultant_length(kappa) * passes_mean_resultant_length(within);
    return r * (3 - r * r) / (1 - r * r);
}

/// Concentration of base lobe `i`, as base_concentration in shaders/maps/base_maps.glsl.
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
    return fmin(within > 0 ? convolved(material->distribution, kappa, within) : kappa, 1e6);
}

uint32_t passes_material_lobes_of(const lobe_material *material, const double normal[3],
                                  double factor, material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES]) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    const uint32_t count = microfacet ? 1 : material->lobe_count;
    for (uint32_t i = 0; i < count; i++) {
        double pole[3] = {0, 0, 1};
        for (int axis = 0; !microfacet && axis < 3; axis++)
            pole[axis] = material->lobes[i].direction[axis];
        passes_material_lobe_rotate(normal, pole, lobes[i].axis);
        lobes[i].concentration = base_concentration(material, i, factor);
        lobes[i].weight = microfacet ? 1 : passes_material_lobe_share(material, i);
    }
    return count;
}

uint32_t passes_material_lobes_read(const device_material *material, double x, double y,
                                    material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES]) {
    bool microfacet = material->material->model == LOBE_MATERIAL_MICROFACET;
    const lobe_grid grid = passes_lobe_grid(material);
    double u = x / grid.width, v = y / grid.height;
    const double factor = microfacet ? (double)material->width_factor : 1;
    double normal[3], widths[4] = {factor, factor, factor, factor};
    const bool has_widths =
        material->maps[MAP_WIDTH].use != NULL && !passes_widths_lie_apart(material);
    if (!sample_normal(material, u, v, normal) ||
        (has_widths && !sample_map(&material->maps[MAP_WIDTH], u, v, widths)))
        return 0;
    return passes_material_lobes_of(material->material, normal, widths[microfacet ? 1 : 0], lobes);
}

void passes_material_lobe_rotate(const double normal[3], const double local[3], double result[3]) {
    double product = normal[0] * local[0] + normal[1] * local[1];
    double quotient = product / (1 + fmax(normal[2], -0.999999));
    result[0] = local[0] + normal[0] * (local[2] - quotient);
    result[1] = local[1] + normal[1] * (local[2] - quotient);
    result[2] = normal[2] * local[2] - product;
}
