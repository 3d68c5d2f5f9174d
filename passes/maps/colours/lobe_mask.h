#ifndef PASSES_MAPS_COLOURS_LOBE_MASK_H
#define PASSES_MAPS_COLOURS_LOBE_MASK_H

#include "passes/upload/material_maps.h"

/// What a mask cuts out of a material's lobe_grid, on the host: for choices that filters make from
/// samples of its maps. Maps of lobes leave the same out (shaders/maps/base_maps.glsl).
typedef struct lobe_mask {
    const lobe_image *image; ///< whose alpha it is; NULL: nothing is cut away
    const lobe_texture_use *use;
    lobe_grid grid;
    lobe_grid texels; ///< of the image
    bool cuts_texels; ///< what is kept may end inside a texel of the grid
    float alpha;      ///< factor of the image's
    float cutoff;
} lobe_mask;

/// Of a material whose lobes are masked; else, and where the host cannot read the image's format,
/// one that cuts nothing away.
lobe_mask passes_lobe_mask(const device_scene *scene, const device_material *material);

/// A point that stands for a texel of the grid, in its texels: the centre or, where the mask may
/// cut a part of the texel away, one at random.
void passes_lobe_mask_point(const lobe_mask *mask, uint32_t x, uint32_t y, double point[2]);

/// Whether a point of the grid is cut away.
bool passes_lobe_mask_cuts(const lobe_mask *mask, const double point[2]);
/// Whether the point is that stands for a texel.
bool passes_lobe_mask_cuts_texel(const lobe_mask *mask, uint32_t x, uint32_t y);

/// The number of texels whose points are not.
uint64_t passes_lobe_mask_count_kept(const lobe_mask *mask);

#endif
