#ifndef PASSES_RENDERER_FRAME_H
#define PASSES_RENDERER_FRAME_H

#include "passes/renderer/delivery.h"

/// Draws one picture in one submission: a single shading pass, sampled at the pixels' centres.
lobe_result passes_frame_render(rendering *r, const frame_delivery *delivery, lobe_frame *frame);

#endif
