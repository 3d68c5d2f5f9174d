#ifndef PASSES_RENDERER_DEFORM_H
#define PASSES_RENDERER_DEFORM_H

#include "passes/context/filter.h"
#include "passes/renderer/motion/pose_history.h"

/// Adds the passes that deform meshes, one for each that is drawn and has a pose: whatever draws
/// the mesh in this frame then reads what it wrote. It is kept while the pose stays the same.
void passes_deform(const filter_context *context);

/// Adds the passes that deform the same meshes as in the frame before, where that was another pose:
/// their previous vertices. A mesh that the host gave no previous vertices of starts from those of
/// this frame.
void passes_deform_previous(const filter_context *context, const pose_history *history);

#endif
