#include "passes/upload/colours/colour_correlation.h"

#include <math.h>
#include <string.h>

#include "passes/upload/colours/mask_alpha.h"
#include "passes/upload/colours/material_colours.h"
#include "passes/upload/material_lobes.h"
#include "passes/upload/material_maps.h"

enum { PATCHES = 8, SAMPLES = 8, NUMBERS = 5 };

/// The least root mean square, over patches of the maps, of the covariance of colour and normal,
/// over the mean colour: light that grazes the surface is brighter or darker by that much.
static const double least_covariance = 0.04;

/// What is measured of a patch: the normal's x and y, and the colour.
typedef struct patch_sums {
    double count, sums[NUMBERS], products[2][3], squares[NUMBERS];
} patch_sums;

static uint32_t hashed(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
}

/// A texel within a stratum of a patch, so that no period of a map is that of the samples.
static uint32_t place_of(uint32_t stratum, uint32_t strata, uint32_t extent, uint32_t seed) {
    const double inside = hashed(seed) / 4294967296.0;
    const uint32_t place = (uint32_t)((stratum + inside) / strata * extent);
    return place < extent ? place : extent - 1;
}

/// Without what a mask cuts away.
static void add_texel(const lobe_scene *scene, const device_material *material,
                      const colour_correlation *inputs, uint32_t x, uint32_t y, patch_sums *patch) {
    material_colours colours;
    double normal[3], numbers[NUMBERS];
    if (!passes_material_colours_read(scene, material, x, y, &colours) ||
        !passes_material_normal_read(material, x + 0.5, y + 0.5, normal))
        return;
    if (colours.alpha * (double)inputs->alpha < (double)inputs->cutoff)
        return;
    for (int i = 0; i < 2; i++)
        numbers[i] = normal[i];
    for (int k = 0; k < 3; k++)
        numbers[2 + k] = colours.albedo[k] * (1 - colours.metallic);
    for (int i = 0; i < NUMBERS; i++)
        if (!isfinite(numbers[i]))
            return;
    patch->count++;
    for (int i = 0; i < NUMBERS; i++) {
        patch->sums[i] += numbers[i];
        patch->squares[i] += numbers[i] * numbers[i];
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++)
            patch->products[i][k] += numbers[i] * numbers[2 + k];
}

/// The square of the covariance, of all channels with the normal, without what so many texels
/// have by chance.
static double square_of_covariance(const patch_sums *patch, double texels) {
    double sum = 0, n = patch->count;
    for (int i = 0; n > 1 && i < 2; i++) {
        const double mean = patch->sums[i] / n, variance = patch->squares[i] / n - mean * mean;
        for (int k = 0; k < 3; k++) {
            const double colour = patch->sums[2 + k] / n;
            const double spread = patch->squares[2 + k] / n - colour * colour;
            const double covariance = patch->products[i][k] / n - mean * colour;
            sum += covariance * covariance - variance * spread / fmin(n, texels);
        }
    }
    return sum;
}

static bool follow_normals(const lobe_scene *scene, const device_material *material,
                           const colour_correlation *inputs) {
    const lobe_grid grid = passes_lobe_grid(material);
    const double texels = fmax((double)grid.width * grid.height / (PATCHES * PATCHES), 1);
    double square = 0, colour = 0, count = 0;
    for (uint32_t p = 0; p < PATCHES * PATCHES; p++) {
        patch_sums patch = {0};
        for (uint32_t i = 0; i < SAMPLES * SAMPLES; i++) {
            const uint32_t seed = 2 * (p * SAMPLES * SAMPLES + i);
            add_texel(
                scene, material, inputs,
                place_of(p % PATCHES * SAMPLES + i % SAMPLES, PATCHES * SAMPLES, grid.width, seed),
                place_of(p / PATCHES * SAMPLES + i / SAMPLES, PATCHES * SAMPLES, grid.height,
                         seed + 1),
                &patch);
        }
        square += square_of_covariance(&patch, texels);
        colour += patch.sums[2] + patch.sums[3] + patch.sums[4];
        count += patch.count;
    }
    colour /= fmax(count, 1);
    return square / (PATCHES * PATCHES) > least_covariance * least_covariance * colour * colour / 3;
}

static bool has_texels(const device_map *map) {
    return map->use && map->width * map->height > 1;
}

/// Whether the host can read the texels.
static bool are_readable(const lobe_scene *scene, const device_material *material) {
    material_colours colours;
    return material->maps[MAP_NORMAL].readable &&
           passes_material_colours_read(scene, material, 0, 0, &colours);
}

/// What the answer depends on.
static colour_correlation inputs_of(const device_scene *scene, const device_material *material) {
    static const uint32_t maps[] = {MAP_BASE_COLOUR, MAP_NORMAL, MAP_WIDTH};
    const bool have_texels =
        has_texels(&material->maps[MAP_BASE_COLOUR]) && has_texels(&material->maps[MAP_NORMAL]);
    colour_correlation inputs = {
        .known = true,
        .lie_alike = have_texels && passes_lobe_grid_shares_coordinates(material, MAP_BASE_COLOUR),
        .images = {-1, -1, -1},
        .normal_scale = material->material->normal_scale,
        .height_scale = material->height_scale,
        .metallic = material->metallic};
    if (material->material->alpha_mask) {
        inputs.alpha = passes_mask_alpha(scene, material);
        inputs.cutoff = material->material->alpha_cutoff;
    }
    for (int i = 0; i < 3; i++) {
        if (material->maps[maps[i]].use)
            inputs.images[i] = material->maps[maps[i]].use->image;
        inputs.texel_versions[i] = material->texel_versions[maps[i]];
    }
    return inputs;
}

static bool have_equal_inputs(const colour_correlation *a, const colour_correlation *b) {
    return memcmp(a->images, b->images, sizeof a->images) == 0 &&
           memcmp(a->texel_versions, b->texel_versions, sizeof a->texel_versions) == 0 &&
           a->normal_scale == b->normal_scale && a->height_scale == b->height_scale &&
           a->metallic == b->metallic && a->alpha == b->alpha && a->cutoff == b->cutoff;
}

bool passes_colours_follow_normals(const device_scene *scene, device_material *material) {
    const colour_correlation *before = &material->colours;
    colour_correlation found = inputs_of(scene, material);
    if (before->known && found.lie_alike == before->lie_alike &&
        (scene->keeps_conclusions || have_equal_inputs(&found, before)))
        return before->follow_normals;
    found.follow_normals = found.lie_alike && (!are_readable(scene->scene, material) ||
                                               follow_normals(scene->scene, material, &found));
    material->colours = found;
    return found.follow_normals;
}
