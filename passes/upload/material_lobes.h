#ifndef PASSES_UPLOAD_MATERIAL_LOBES_H
#define PASSES_UPLOAD_MATERIAL_LOBES_H

#include "passes/upload/device_scene.h"

/// A material's base lobes as von Mises-Fisher lobes, texel by texel, on the host: for choices
/// that are made once a material, from samples of its maps.
typedef struct material_lobe {
    double axis[3]; ///< unit, in the tangent frame
    double concentration;
    double weight; ///< share of the texel's reflectance
} material_lobe;

/// Texels of the grid that the lobes come from: the larger of the normal and the width map.
void passes_material_lobe_extent(const device_material *material, uint32_t *width,
                                 uint32_t *height);

/// The lobes of a texel of that grid, at most LOBE_MATERIAL_MAXIMUM_LOBES; how many. 0 where a map
/// has a format that hosts do not read.
uint32_t passes_material_lobes_read(const lobe_scene *scene, const device_material *material,
                                    uint32_t x, uint32_t y,
                                    material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES]);

/// As rotate_from_pole in shaders/lib/lobe/half_vector_lobe.glsl, above the equator.
void passes_material_lobe_rotate(const double normal[3], const double local[3], double result[3]);

#endif
