#ifndef PASSES_UPLOAD_COLOURS_LOBE_MASK_H
#define PASSES_UPLOAD_COLOURS_LOBE_MASK_H

#include "passes/upload/material_maps.h"

/// What a mask cuts out of a material's lobe_grid, on the host: for choices that filters make from
/// samples of its maps. Maps of lobes leave the same out (shaders/maps/base_maps.glsl).
typedef struct lobe_mask {
    const lobe_image *image; ///< whose alpha it is; NULL: nothing is cut away
    lobe_grid grid;
    float alpha; ///< factor of the image's
    float cutoff;
} lobe_mask;

/// Of a material whose lobes are masked; else, and where the host cannot read the image's format,
/// one that cuts nothing away.
lobe_mask passes_lobe_mask(const device_scene *scene, const device_material *material);

/// Whether a texel of the grid is cut away.
bool passes_lobe_mask_cuts(const lobe_mask *mask, uint32_t x, uint32_t y);

/// The number of texels that are not.
uint64_t passes_lobe_mask_count_kept(const lobe_mask *mask);

#endif
