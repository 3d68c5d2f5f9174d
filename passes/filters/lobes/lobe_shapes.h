#ifndef PASSES_FILTERS_LOBES_LOBE_SHAPES_H
#define PASSES_FILTERS_LOBES_LOBE_SHAPES_H

#include "passes/upload/material_lobes.h"

/// Lobes as shading draws them, on the host, as densities per steradian. Concentrations as in
/// material_lobe; directions are unit vectors.

/// Whether base lobes have a shape of their own that a mixture's lobes keep in part, as keeps_shape
/// in shaders/filters/lobes.glsl; else all are von Mises-Fisher lobes.
bool passes_lobes_keep_shape(const lobe_material *material);

/// Xu et al. 2017, Eq. 6: of integral one, as in shaders/lib/lobe/von_mises_fisher.glsl.
double passes_lobe_von_mises_fisher(const double axis[3], double concentration,
                                    const double direction[3]);
/// The projected area of such a lobe above its own horizon (0, 1], and the inverse of
/// passes_mean_resultant_length.
double passes_lobe_projected_area(double concentration);
double passes_lobe_concentration(double mean_resultant_length);

/// A distribution of microfacet normals of projected area one, as in
/// shaders/lib/microfacet/normal_distribution.glsl.
double passes_lobe_of_microfacets(lobe_distribution distribution, const double axis[3],
                                  double concentration, const double direction[3]);

/// A base lobe of the material, without its weight.
double passes_lobe_of_base(const lobe_material *material, const material_lobe *lobe,
                           const double direction[3]);

/// A direction in proportion to a base lobe: of those whose shape is kept times the cosine about
/// the axis. `position`: [0, 1) each.
void passes_lobe_draw(const lobe_material *material, const material_lobe *lobe,
                      const float position[2], double direction[3]);

#endif
