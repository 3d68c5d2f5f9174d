#ifndef TESTS_PASSES_SUPPORT_MIXTURE_REFERENCE_H
#define TESTS_PASSES_SUPPORT_MIXTURE_REFERENCE_H

#include <lobe/scene.h>

#include "passes/filters/lobes/clustering.h"
#include "tests/passes/support/map_reference.h"
#include "tests/reference/mixture/layers.h"

/// What lobe_clustering computes, in double precision and directly from a material's maps.

/// Zeroes for every texel of the lobes' maps: the larger of the normal and the width map, each way.
/// The caller frees the result.
reference_layers allocate_lobe_texels(const lobe_scene *scene, const lobe_material *material,
                                      uint32_t layers);
/// Normal and factor of the width at a point of one of those texels (texel_points.offsets).
void read_lobe_point(const lobe_scene *scene, const lobe_material *material,
                     const reference_layers *size, uint32_t x, uint32_t y, const double offset[2],
                     double normal[3], double width[4]);

/// The frame of a texel as columns (tangent, bitangent, normal); false: the texel is left out.
typedef bool (*texel_frame)(const void *user, double u, double v, double frame[3][3]);

/// The mixture of every texel of the maps, all layers of tests/reference/mixture/lobe_mixture.h.
/// `frame` NULL: tangent space. To free by the caller.
reference_layers mixture_of_texels(const lobe_scene *scene, const lobe_material *material,
                                   texel_frame frame, const void *user);

/// What parameter_averaging averages, of every texel: the mean of its points' normals, and of the
/// concentration of microfacets or the factor of the widths of half-vector lobes. To free by the
/// caller.
reference_layers averaged_parameters_of_texels(const lobe_scene *scene,
                                               const lobe_material *material);

/// The moments that slope_moments computes for every texel: the layers of
/// shaders/interface/slope_moments.h. To free by the caller.
reference_layers slope_moments_of_texels(const lobe_scene *scene, const lobe_material *material);

/// Layer of the reference that a layer of a mixture map holds.
uint32_t mixture_reference_layer(const mixture_map *mixture, uint32_t layer);

/// Fails unless every level of a map that was read back, layers within levels, is the mean of the
/// one before it, from `texels` on: by induction, that of all texels of the maps. Each value may be
/// off by `tolerance` of itself and 0.1, and by `rounding` once more on every level.
void check_reduced_levels(const reduced_map *map, const float *texel,
                          const reference_layers *texels, double tolerance, double rounding);

/// Base lobe `i` of a material of half-vector lobes, or of microfacets (i = 0): its parameter (as
/// in tests/reference/lobe/base_lobe.h) and its concentration where the width map's texel is
/// `width`; its share of the reflectance.
double base_lobe_parameter(const lobe_material *material, uint32_t i, const double width[4]);
double base_lobe_share(const lobe_material *material, uint32_t i);
double base_lobe_concentration(const lobe_material *material, uint32_t i, const double width[4]);

#endif
