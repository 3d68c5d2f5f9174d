#include "passes/maps/material_patch.h"

#include <math.h>

#include "passes/context/sample_pattern.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"

/// Xu et al. 2017, Eq. 6, as in shaders/lib/lobe/von_mises_fisher.glsl.
static double evaluate(const material_lobe *lobe, const double direction[3]) {
    double kappa = fmax(lobe->concentration, 1e-20), square = 0;
    for (int i = 0; i < 3; i++)
        square += (direction[i] - lobe->axis[i]) * (direction[i] - lobe->axis[i]);
    return lobe->weight * kappa / (-2 * M_PI * expm1(-2 * kappa)) * exp(-0.5 * kappa * square);
}

double passes_material_lobes_evaluate(const material_lobe *lobes, size_t count,
                                      const double direction[3]) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += evaluate(&lobes[i], direction);
    return sum;
}

double passes_material_patch_evaluate(const material_patch *patch, const double direction[3]) {
    return passes_material_lobes_evaluate(patch->lobes, patch->count, direction);
}

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

bool passes_material_patch_read(const device_material *material, const lobe_mask *mask,
                                uint32_t index, material_patch *patch) {
    const patch_place at = place_patch(material, index);
    uint32_t kept = 0;
    patch->count = 0;
    for (uint32_t i = 0; i < at.columns * at.rows; i++) {
        double point[2];
        place_point(&at, mask, i, point);
        if (passes_lobe_mask_cuts(mask, point))
            continue;
        kept++;
        uint32_t count =
            passes_material_lobes_read(material, point[0], point[1], &patch->lobes[patch->count]);
        if (count == 0)
            return false;
        patch->count += count;
    }
    for (size_t i = 0; i < patch->count; i++)
        patch->lobes[i].weight /= kept;
    return true;
}

void passes_material_patch_draw(const material_patch *patch, uint32_t index, double direction[3]) {
    const material_lobe *lobe = &patch->lobes[index * 7919u % patch->count];
    float position[2];
    passes_sample_position(index, MATERIAL_PATCH_DIRECTIONS, position);
    double angle = 2 * M_PI * position[1];
    // The inverse of a narrow lobe's distribution in 1 - cos.
    double versine = fmin(-log1p(-0.999 * position[0]) / fmax(lobe->concentration, 1), 2);
    double sine = sqrt(versine * (2 - versine));
    double local[3] = {sine * cos(angle), sine * sin(angle), 1 - versine};
    passes_material_lobe_rotate(lobe->axis, local, direction);
}
