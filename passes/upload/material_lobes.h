#ifndef PASSES_UPLOAD_MATERIAL_LOBES_H
#define PASSES_UPLOAD_MATERIAL_LOBES_H

#include "passes/upload/device_scene.h"

/// A material's base lobes as von Mises-Fisher lobes, point by point, on the host: for choices that
/// filters make once for a material, from samples of its maps.
typedef struct material_lobe {
    double axis[3]; ///< unit, in the tangent frame
    double concentration;
    double weight; ///< share of the point's reflectance
} material_lobe;

/// The share of one lobe in a half-vector material's reflectance, by luminance [0, 1].
float passes_material_lobe_share(const lobe_material *material, uint32_t lobe);

/// The lobes of a point with this unit normal and factor of the widths; returns their number, at
/// most LOBE_MATERIAL_MAXIMUM_LOBES.
uint32_t passes_material_lobes_of(const lobe_material *material, const double normal[3],
                                  double factor, material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES]);

/// Computes the lobes of the surface at a point, as shading sees it there: interpolated between
/// texels if the maps' samplers do so. Returns their number, at most LOBE_MATERIAL_MAXIMUM_LOBES; 0
/// if a map has a format that the host does not read. `x`, `y`: texels of the material's lobe_grid,
/// from its upper left corner; the centre of the first texel is at 0.5.
uint32_t passes_material_lobes_read(const device_material *material, double x, double y,
                                    material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES]);

/// As rotate_from_pole in shaders/lib/lobe/half_vector_lobe.glsl, above the equator.
void passes_material_lobe_rotate(const double normal[3], const double local[3], double result[3]);

/// Length [0, 1) of the mean direction of a von Mises-Fisher distribution of concentration kappa
/// [0, infinity): coth kappa - 1/kappa. (Mardia, Jupp 2000, section 9.3.)
double passes_mean_resultant_length(double kappa);

/// Texel `i` of a row of `size`, where `i` may lie outside it.
uint32_t passes_wrapped_texel(int64_t i, uint32_t size, lobe_scene_wrap wrap);

#endif
