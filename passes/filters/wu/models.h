#ifndef PASSES_FILTERS_WU_MODELS_H
#define PASSES_FILTERS_WU_MODELS_H

#include "passes/filters/wu/build.h"

/// Adds the passes that make the models of a material with a relief. They run when its heights or
/// their scale change, not when colours do.
wu_models passes_wu_models(const filter_context *context, uint32_t material, const wu_kind *kind);

#endif
