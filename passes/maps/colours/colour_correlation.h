#ifndef PASSES_MAPS_COLOURS_COLOUR_CORRELATION_H
#define PASSES_MAPS_COLOURS_COLOUR_CORRELATION_H

#include "passes/context/filter.h"

/// Whether the diffuse colours of a material go with its normals somewhere on its maps, so that the
/// mean of their products is not the product of their means. A pass finds it on the device. Frames
/// that are waited for have its answer before they are declared. Other frames, and those whose
/// texels the host gives on the device, read it there until it has come back.

/// Whether the maps of both have texels and lie on the surface alike: only then it is a question.
bool passes_colours_lie_like_normals(const device_material *material);

/// Asks about all materials for which the filter must know, in a frame aside, and waits for the
/// answers.
lobe_result passes_colour_correlations_ask(const filter_context *context);

/// False if they do not lie alike, or it is known that colours do not follow.
bool passes_colours_may_follow_normals(const filter_context *context, uint32_t material);

/// Of a material whose maps lie alike: a buffer of struct colour_correlation_found, once for all
/// that ask in a frame. Adds the pass if the answer is not known.
lobe_resource passes_colour_correlation(const filter_context *context, uint32_t material);

/// Once that has been asked for: whether its `groups` hold, with which a map is to be made.
bool passes_colour_correlation_decides(const filter_context *context, uint32_t material);

#endif
