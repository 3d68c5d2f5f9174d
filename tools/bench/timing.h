#ifndef TOOLS_BENCH_TIMING_H
#define TOOLS_BENCH_TIMING_H

#include <stddef.h>

#include <lobe/profile.h>
#include <lobe/renderer.h>

/// Adds a rendered frame, with all its submissions, as one frame of the profile. Errors:
/// LOBE_ERROR_OUT_OF_MEMORY, logged.
lobe_result timing_add(lobe_profile *profile, const lobe_frame *frame, const lobe_host *host);

/// The median of `count` values, at least one, which it sorts; for an even count, the mean of the
/// two in the middle.
double timing_median(double *values, size_t count);

#endif
