#ifndef PASSES_RENDERER_SURFACES_H
#define PASSES_RENDERER_SURFACES_H

#include "passes/renderer/shading.h"

/// Deferred shading: a picture of what shading needs of the surfaces that are seen is drawn first;
/// then each batch is shaded in one draw that passes over other batches' pixels. Devices shade
/// blocks of pixels, on lavapipe 4x4, for each triangle that touches them: this way, small
/// triangles cost no more than large ones. The picture is the same, bit by bit, except where two
/// batches lie at the same depth and one of them is not held (below).

typedef struct seen_surfaces {
    bool present;
    bool holds_all;        ///< other batches are drawn by their triangles, afterwards
    lobe_resource layers;  ///< RGBA32_FLOAT, shaders/interface/surfaces.h; else one white texel
    lobe_resource numbers; ///< D32_FLOAT: the numbers of the batches that are seen
} seen_surfaces;

/// Whether a picture holds a batch. It does not if a mask cuts holes into it, for that takes the
/// filter's shader, or if maps use the second set of texture coordinates.
bool passes_surfaces_hold(const filter_context *context, const instance_batch *batch);

/// What shading binds where there is no picture.
seen_surfaces passes_surfaces_absent(const filter_context *context);

/// Draws the picture, and the targets' depth, if the knob `shading` says so. `frame`: buffer of
/// struct frame_constants.
seen_surfaces passes_surfaces(const filter_context *context, const draw_list *draws,
                              lobe_resource frame, const shading_selection *selection, bool shadows,
                              shading_targets *targets);

#endif
