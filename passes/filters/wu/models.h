#ifndef PASSES_FILTERS_WU_MODELS_H
#define PASSES_FILTERS_WU_MODELS_H

#include "passes/filters/wu/build.h"

/// Whether buffers can hold the cells of a material's relief.
bool passes_wu_fits(const device_material *material);

/// The parts of the work: paths, then each level.
uint32_t passes_wu_part_count(const device_material *material, const wu_kind *kind);

/// Adds the passes that make the models of a material with a relief. They run when its heights or
/// their scale change, not when colours do. A relief whose cells a buffer cannot hold fails the
/// frame.
/// `parts`: those that are added, from the first on; UINT32_MAX: all. Without the last one, the
/// models have no content. `in_parts`: what later parts need is kept between frames.
wu_models passes_wu_models(const filter_context *context, uint32_t material, const wu_kind *kind,
                           uint32_t parts, bool in_parts);

#endif
