#ifndef LOBE_PROFILE_H
#define LOBE_PROFILE_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/graph.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Times of frames and their passes over many frames, gathered from the reports of executed graphs:
/// of the device, but for `host`.
/// Not thread-safe: one profile, one thread.
typedef struct lobe_profile lobe_profile;

/// `host` is copied; NULL: silent. Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result lobe_profile_create(const lobe_host *host, lobe_profile **profile);
/// Clears the pointer; NULL is fine.
void lobe_profile_destroy(lobe_profile **profile);

/// Adds one frame, as lobe_graph_describe gives it after lobe_graph_execute. Nothing of the report
/// is kept. Passes of one name count as one pass: their times are summed.
/// Errors: LOBE_ERROR_OUT_OF_MEMORY; the frame is then not counted.
lobe_result lobe_profile_add(lobe_profile *profile, const lobe_graph_report *report);

/// Times of one pass in the frames in which it ran, or of whole frames.
typedef struct lobe_profile_times {
    const char *name;
    double median_milliseconds; ///< of an even number of frames: the mean of the middle two
    double p95_milliseconds; ///< the smallest time that at least 95 % of the frames do not exceed
    double share;  ///< of all frames' time, [0, 1]; what passes leave is time between them
    uint32_t runs; ///< frames in which it ran
} lobe_profile_times;

typedef struct lobe_profile_summary {
    const lobe_profile_times *passes; ///< all that ran at least once, in order of appearance
    size_t pass_count;
    lobe_profile_times frame; ///< whole frames
    lobe_profile_times host;  ///< CPU time to compile and record whole frames; no share
} lobe_profile_summary;

/// Statistics of all frames so far; with none, all is 0. Pointers live until the next call with
/// the profile. Errors: LOBE_ERROR_OUT_OF_MEMORY; there are then no passes, and no frames.
lobe_result lobe_profile_statistics(lobe_profile *profile, lobe_profile_summary *summary);

#ifdef __cplusplus
}
#endif

#endif
