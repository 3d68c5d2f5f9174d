#ifndef PASSES_MAPS_MOMENT_MAP_H
#define PASSES_MAPS_MOMENT_MAP_H

#include <stdbool.h>

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"

/// A map of lobe moments in bins, and how shaders/filters/moments.glsl shades from it, for all
/// filters that build one. Its layers are described in shaders/interface/moment_bins.h.
typedef struct moment_map {
    reduced_map map;
    lobe_format format;
    lobe_resource bins; ///< uniform block of struct moment_binning_constants
    /// Where bins must not be blended with those of neighbouring texels (mixture_likeness); version
    /// 0: they may be everywhere.
    lobe_resource likeness;
} moment_map;

extern const filter_knob passes_knob_least_share, passes_knob_bin_storage;

/// The format of the map that the knob "storage" selects.
lobe_format passes_bin_format(const filter_context *context);

/// Layers of a map of the material's lobes in bins.
uint32_t passes_bin_layers(const device_material *material, uint32_t bins, bool own_colours);

/// What shading needs to know of the bins of a material whose lobes vary.
void passes_bins_specialise(const device_material *material, uint32_t bins, bool own_colours,
                            filtered_appearance *appearance);

/// Whether base lobes differ in width, in a texel or from texel to texel.
bool passes_bin_widths_vary(const device_material *material);

/// Binds the map and the colour maps to the shading. `moments`: NULL if lobes do not vary.
void passes_bin_appearance_bind(const filter_context *context, uint32_t material,
                                const moment_map *moments, filtered_appearance *appearance);
/// For the shading of moments.glsl: binds the map once more, to be read texel by texel, and
/// `likeness`, or what stands for it where the shader is not specialised to read it. `moments`: as
/// above.
void passes_bin_texels_bind(const filter_context *context, uint32_t material,
                            const moment_map *moments, filtered_appearance *appearance);

#endif
