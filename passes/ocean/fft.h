#ifndef PASSES_OCEAN_FFT_H
#define PASSES_OCEAN_FFT_H

#include <lobe/graph.h>

/// Two forms of the same transform.
typedef enum fft_form {
    FFT_THROUGH_MEMORY, ///< a pass for each step: for software drivers
    FFT_IN_GROUPS, ///< a pass for all rows, another for all columns, in shared memory: for GPUs
} fft_form;

/// Sides that both forms take: powers of two.
#define FFT_SMALLEST 8
#define FFT_LARGEST  1024

/// Fills `size` complex numbers e^(2 pi i j/size), for fft_transform.
void passes_fft_roots(uint32_t size, float *roots);

/// Adds passes "fft" that transform `count` planes of size x size vec4, each of two complex
/// numbers:
///   target(x, y) = sum over n, m of source(n, m) e^(2 pi i (n x + m y)/size),
/// not scaled. `source` is a buffer of all planes, row by row; `roots` one of those roots. The
/// result goes into the layers of `target`, an image of that extent and RGBA32_FLOAT. Returns its
/// new version.
lobe_resource passes_fft(lobe_graph *graph, fft_form form, uint32_t size, uint32_t count,
                         lobe_resource source, lobe_resource roots, lobe_resource target);

#endif
