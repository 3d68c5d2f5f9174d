#ifndef PASSES_RENDERER_SAMPLES_SAMPLE_CHOICE_H
#define PASSES_RENDERER_SAMPLES_SAMPLE_CHOICE_H

#include "passes/renderer/draw_list.h"

/// Which pixels take how many samples.
typedef struct sample_choice {
    lobe_resource counts; ///< R32_FLOAT: samples of each pixel
    lobe_resource list;   ///< buffer: the pixels that take more than one
    /// Buffer: lobe_dispatch_arguments of one invocation in a group of 64 for each of those pixels,
    /// and after 20 bytes lobe_draw_arguments of each draw of a shading pass. If there are no such
    /// pixels, they dispatch and draw nothing.
    lobe_resource arguments;
} sample_choice;

/// Adds the passes that choose the number of samples of each pixel, within what the knob `samples`
/// asks for. `radiance`: the first sample of each; alpha is its depth. `blended`: the picture will
/// be blended over another, of unknown content.
sample_choice passes_sample_choice(const filter_context *context, const draw_list *draws,
                                   lobe_resource radiance, bool blended);

#endif
