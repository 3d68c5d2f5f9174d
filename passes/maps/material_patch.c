#include "passes/maps/material_patch.h"

#include <lobe/colour.h>
#include <math.h>

#include "passes/context/sample_pattern.h"
#include "passes/maps/colours/mirrored_luminance.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"
#include "shaders/interface/mirrored.h"

/// Where a patch lies in the lobe_grid, texels.
typedef struct patch_place {
    uint32_t left, top, columns, rows;
} patch_place;

static patch_place place_patch(const device_material *material, uint32_t index) {
    const lobe_grid grid = passes_lobe_grid(material);
    double position[2];
    passes_spread_position(index, MATERIAL_PATCHES, position);
    patch_place at = {
        .columns = grid.width < MATERIAL_PATCH_EXTENT ? grid.width : MATERIAL_PATCH_EXTENT,
        .rows = grid.height < MATERIAL_PATCH_EXTENT ? grid.height : MATERIAL_PATCH_EXTENT};
    at.left = (uint32_t)(position[0] * (grid.width - at.columns + 1));
    at.top = (uint32_t)(position[1] * (grid.height - at.rows + 1));
    return at;
}

/// Where texel `i` of the patch's columns * rows is read, in texels of the lobe_grid.
static void place_point(const patch_place *at, const lobe_mask *mask, uint32_t i, double point[2]) {
    const uint32_t x = at->left + i % at->columns, y = at->top + i / at->columns;
    if (mask->cuts_texels) {
        passes_lobe_mask_point(mask, x, y, point);
        return;
    }
    // One point in every texel is enough: see shaders/lib/map/texel_point.glsl.
    point[0] = x + 0.5 + TEXEL_POINT;
    point[1] = y + 0.5 + TEXEL_POINT;
}

/// By what a texel mirrors, as shaders/maps/mirrored_luminance.glsl does.
static double weight_of(const material_colours *colours) {
    const float specular[3] = {(float)colours->specular[0], (float)colours->specular[1],
                               (float)colours->specular[2]};
    // Texels may hold anything.
    const double luminance = fmin(fmax((double)lobe_luminance(specular), 0), 1e3);
    return (1 - LEAST_MIRRORED) * luminance + LEAST_MIRRORED;
}

/// Multiplies the weights of the patch's last lobes, which are those of a texel.
static void weight_texel(const device_scene *scene, const device_material *material,
                         const patch_place *at, uint32_t i, material_patch *patch) {
    const size_t last = patch->count - 1;
    if (!patch->has_colours)
        return;
    patch->has_colours =
        passes_material_colours_read(scene->scene, material, at->left + i % at->columns,
                                     at->top + i / at->columns, &patch->colours[last]);
    if (patch->has_colours)
        patch->lobes[last].weight *= weight_of(&patch->colours[last]);
}

bool passes_material_patch_read(const device_scene *scene, const device_material *material,
                                const lobe_mask *mask, uint32_t index, material_patch *patch) {
    const patch_place at = place_patch(material, index);
    patch->count = 0;
    patch->has_colours = passes_mirrored_luminance_varies(material);
    for (uint32_t i = 0; i < at.columns * at.rows; i++) {
        double point[2];
        place_point(&at, mask, i, point);
        if (passes_lobe_mask_cuts(mask, point))
            continue;
        uint32_t count =
            passes_material_lobes_read(material, point[0], point[1], &patch->lobes[patch->count]);
        if (count == 0)
            return false;
        patch->count += count;
        weight_texel(scene, material, &at, i, patch);
    }
    double sum = 0;
    for (size_t i = 0; i < patch->count; i++)
        sum += patch->lobes[i].weight;
    for (size_t i = 0; i < patch->count; i++)
        patch->lobes[i].weight /= sum;
    return true;
}
