#ifndef PASSES_RENDERER_SURFACES_DEFERRAL_H
#define PASSES_RENDERER_SURFACES_DEFERRAL_H

#include "passes/renderer/draw_list.h"

/// Whether a picture of surfaces holds a batch. It does not if maps use the second set of texture
/// coordinates, or if a mask cuts holes into it that are known only later.
bool passes_surfaces_hold(const filter_context *context, const instance_batch *batch);

/// Only pipelines are made, and frames to come, perhaps of larger scenes, will choose with `auto`:
/// both ways are prepared.
bool passes_shading_is_open(const filter_context *context);

/// Whether surfaces are shaded from a picture of them (surfaces.h), as the knob `shading` says:
/// with `auto`, on CPUs where that is likely to take less time.
bool passes_defers_shading(const filter_context *context, const draw_list *draws);

#endif
