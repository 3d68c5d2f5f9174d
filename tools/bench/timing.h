#ifndef TOOLS_BENCH_TIMING_H
#define TOOLS_BENCH_TIMING_H

#include <lobe/profile.h>
#include <lobe/renderer.h>

/// Adds a rendered frame, of however many submissions, as one frame of the profile.
/// Errors: LOBE_ERROR_OUT_OF_MEMORY, logged.
lobe_result timing_add(lobe_profile *profile, const lobe_frame *frame, const lobe_host *host);

#endif
