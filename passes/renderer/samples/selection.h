#ifndef PASSES_RENDERER_SAMPLES_SELECTION_H
#define PASSES_RENDERER_SAMPLES_SELECTION_H

#include <lobe/graph.h>

/// The draws of a shading pass with a selection, in order: of a mask, of the background, and of
/// each batch.
enum { MASK_DRAW, BACKGROUND_DRAW, FIRST_INSTANCE_DRAW };

/// The pixels that a shading pass draws: those that take more than one sample.
typedef struct shading_selection {
    lobe_resource counts;    ///< R32_FLOAT: samples of each pixel
    lobe_resource occluder;  ///< D32_FLOAT: hides what lies behind it; all zero: nothing is hidden
    lobe_resource arguments; ///< lobe_draw_arguments of each of the pass's draws, in order
    size_t first_argument;   ///< index of the first draw's
} shading_selection;

/// A draw, by its number, takes its counts from those of a selection; NULL: as it is.
void passes_selection_count(const shading_selection *selection, size_t number, lobe_draw *draw);
/// Lets through the selected pixels alone: all others get the nearest depth. `shader`: writes it.
void passes_selection_mask(lobe_pass *pass, const shading_selection *selection, const char *shader);

#endif
