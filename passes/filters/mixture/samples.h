#ifndef PASSES_FILTERS_MIXTURE_SAMPLES_H
#define PASSES_FILTERS_MIXTURE_SAMPLES_H

#include "passes/context/filter.h"

/// The lobes of a material's maps as samples, see shaders/interface/gaussian_mixture.h: transient.
typedef struct mixture_samples {
    lobe_resource lobes;    ///< a texel for each of the lobe grid
    lobe_resource extremes; ///< a struct mixture_extremes for each tile
    uint32_t tiles;
    uint32_t width, height; ///< of the lobe grid, texels
} mixture_samples;

/// Adds the pass that writes the samples of a material that has a normal or a width map.
/// `plane`: MIXTURE_PLANE_... of their places. `own_colours`: samples have specular colours.
/// `retained`: they are kept between frames.
mixture_samples passes_mixture_samples(const filter_context *context, uint32_t material,
                                       uint32_t plane, bool own_colours, bool retained);

#endif
