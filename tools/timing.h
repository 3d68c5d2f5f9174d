#ifndef TOOLS_TIMING_H
#define TOOLS_TIMING_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/renderer.h>

/// Milliseconds of one thing, measured several times.
typedef struct timing_samples {
    double *milliseconds;
    size_t count;
} timing_samples;

typedef struct timing_pass {
    char name[64];
    timing_samples samples; ///< of the frames in which it ran
} timing_pass;

/// Device times over many frames. All zero: none yet.
typedef struct timing {
    timing_samples frames; ///< whole frames
    timing_pass *passes;   ///< in order of their first run
    size_t pass_count;
} timing;

/// Adds a frame. False without memory; the timing is still to be freed.
bool timing_add(timing *timing, const lobe_frame *frame);
/// Zeroes the structure as well.
void timing_free(timing *timing);

/// The value that `part` [0, 1] of all samples lie below, interpolated between neighbours; 0
/// where there are none. Median: 0.5.
double timing_quantile(const timing_samples *samples, double part);

#endif
