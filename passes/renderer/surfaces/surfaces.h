#ifndef PASSES_RENDERER_SURFACES_SURFACES_H
#define PASSES_RENDERER_SURFACES_SURFACES_H

#include "passes/renderer/samples/selection.h"
#include "passes/renderer/surfaces/deferral.h"
#include "passes/renderer/surfaces/targets.h"

/// Deferred shading: a picture of what shading needs of the surfaces that are seen is drawn first;
/// then each batch is shaded in one draw that passes over other batches' pixels, of the rectangle
/// in which it is seen. Devices shade blocks of pixels, on lavapipe 4x4, for each triangle that
/// touches them: this way, small triangles cost no more than large ones. The picture is the same,
/// bit by bit, except where two batches lie at the same depth and one of them is not held
/// (deferral.h).

typedef struct seen_surfaces {
    bool present;
    bool holds_all; ///< else others are drawn by their triangles, afterwards
    bool open;      ///< all batches are drawn by their triangles, too (deferral.h)
    /// RGBA32_FLOAT, see shaders/interface/picture/surfaces.h; one white texel if not present.
    lobe_resource layers;
    lobe_resource numbers;    ///< D32_FLOAT: the numbers of the batches that are seen
    lobe_resource rectangles; ///< buffer of struct surface_rectangle
} seen_surfaces;

/// Whether a pass draws a batch: one that reads the picture (`deferred`), or one of triangles.
bool passes_surfaces_show(const filter_context *context, const seen_surfaces *surfaces,
                          const instance_batch *batch, bool deferred);
/// What draws a batch where the picture shows it, in a pass whose depths are `numbers`. It reads
/// the layers and what passes_surfaces_binding returns.
void passes_surfaces_set_draw(lobe_draw *draw);
lobe_binding passes_surfaces_binding(const seen_surfaces *surfaces);

/// What shading binds where there is no picture.
seen_surfaces passes_surfaces_absent(const filter_context *context);

/// Draws the picture, and the targets' depth, if the knob `shading` says so. `frame`: buffer of
/// struct frame_constants.
seen_surfaces passes_surfaces(const filter_context *context, const draw_list *draws,
                              lobe_resource frame, const shading_selection *selection,
                              shading_targets *targets);

#endif
