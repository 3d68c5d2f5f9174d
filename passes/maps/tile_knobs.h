#ifndef PASSES_MAPS_TILE_KNOBS_H
#define PASSES_MAPS_TILE_KNOBS_H

#include "passes/context/filter.h"

/// Knobs of filters that can make their maps so.
extern const filter_knob passes_knob_built, passes_knob_texel_samples;

/// Whether the knobs ask for it, and the frame allows it: one sample for each pixel, no anisotropic
/// sampler, whose texels are the device's choice.
bool passes_wants_seen_tiles(const filter_context *context);

/// The knob `texel_samples`, along each axis of a texel; 0: all texels, also where maps are made
/// whole.
uint32_t passes_texel_samples(const filter_context *context);

#endif
