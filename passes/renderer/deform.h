#ifndef PASSES_RENDERER_DEFORM_H
#define PASSES_RENDERER_DEFORM_H

#include "passes/context/filter.h"

/// Adds the passes that deform meshes, one for each that is drawn and has a pose: whatever draws
/// the mesh in this frame then reads what it wrote. It is kept while the pose stays the same.
void passes_deform(const filter_context *context);

#endif
