#ifndef PASSES_RENDERER_PICTURE_DRAWING_H
#define PASSES_RENDERER_PICTURE_DRAWING_H

#include "passes/renderer/shading.h"

/// Adds the pass that draws a finished picture, as large as the targets, into their radiance; with
/// `keep_radiance`, blended over its contents. `texels`: width * height of RGBA, radiance times
/// coverage and coverage; copied.
void passes_picture_drawing(lobe_graph *graph, const float *texels, shading_targets *targets);

#endif
