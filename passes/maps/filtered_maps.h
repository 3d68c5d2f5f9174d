#ifndef PASSES_MAPS_FILTERED_MAPS_H
#define PASSES_MAPS_FILTERED_MAPS_H

#include "passes/context/filter.h"

/// Adds what shaders/shading/colours/filtered_material.glsl reads: the colour maps of a material,
/// filtered linearly (each image once for all materials; the base colours under a mask as in
/// passes/maps/colours/mask_coverage.h, with metal as in passes/maps/colours/metal_means.h),
/// how they go with normals (passes/maps/colours/colour_normals.h), and the knobs of the footprint.
void passes_filtered_maps_build(const filter_context *context, uint32_t material,
                                filtered_appearance *appearance);

/// Whether that makes a filtered image of a material's map.
bool passes_filtered_map_is_image(const device_material *material, uint32_t map);

/// The format of filtered maps that the knob "storage" selects.
lobe_format passes_filtered_map_format(const filter_context *context);

/// Trilinear, as anisotropic as the knob says, with the wrapping of the material's map.
lobe_sampler passes_filtered_map_sampler(const filter_context *context,
                                         const device_material *material, uint32_t map);

/// Knobs of all filters that read filtered maps: put them last in a filter's list.
///
/// bias: an interpolated texel spreads over twice its width, so the level whose texels are as large
/// as a pixel blurs more than the pixel's box does (variance 1/4 against 1/12). Half a level less
/// is closer: error of `lobes` against 64 samples at 640x360, bias 0 and -0.5: tablecloth 0.1365,
/// 0.1338; checkerboard 0.646, 0.627; rusted metal on a sphere 0.170, 0.129.
///
/// curvature: 1 is the variance of the interpolated normals under the pixel's box.
extern const filter_knob passes_knob_probes, passes_knob_anisotropy, passes_knob_bias,
    passes_knob_level_blend, passes_knob_curvature;

/// The format of maps of numbers that lie between 0 and 1, or are directions.
/// float16 halves the memory of mixtures. |r| near 1 is then rounded to 5e-4, which costs
/// 6 % of kappa at 128 and half of it at 1000, where float32 loses 4e-5. In pictures: tablecloth
/// (kappa 128) 1.3 % apart (relative L2), errors against the reference equal to three digits.
extern const filter_knob passes_knob_storage;

#endif
