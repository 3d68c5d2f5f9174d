#ifndef PASSES_RENDERER_REFERENCE_H
#define PASSES_RENDERER_REFERENCE_H

#include "passes/renderer/delivery.h"

/// Renders the reference: the mean of many samples per pixel, taken in several submissions.
lobe_result passes_reference_render(rendering *r, const frame_delivery *delivery,
                                    lobe_frame *frame);

#endif
