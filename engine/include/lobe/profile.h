#ifndef LOBE_PROFILE_H
#define LOBE_PROFILE_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/graph.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Times of frames and of their passes over many frames, gathered from the reports of executed
/// graphs. All are device times, except `host`.
/// Not thread-safe: one profile, one thread.
typedef struct lobe_profile lobe_profile;

/// `host` is copied; NULL: silent. Errors: LOBE_ERROR_OUT_OF_MEMORY.
LOBE_API lobe_result lobe_profile_create(const lobe_host *host, lobe_profile **profile);
/// Clears the pointer; NULL is allowed.
LOBE_API void lobe_profile_destroy(lobe_profile **profile);

/// Adds one frame: the report of lobe_graph_describe after lobe_graph_execute, which is copied.
/// Passes with the same name count as one pass: their times are summed.
/// Errors: LOBE_ERROR_OUT_OF_MEMORY; the frame is not counted then.
LOBE_API lobe_result lobe_profile_add(lobe_profile *profile, const lobe_graph_report *report);

/// Times of one pass over the frames in which it ran, or of whole frames.
typedef struct lobe_profile_times {
    const char *name;
    double median_milliseconds; ///< for an even number of frames: the mean of the middle two
    double p95_milliseconds; ///< the smallest time that at least 95 % of the frames do not exceed
    double share;            ///< of the time of all frames, [0, 1]; the rest is time between passes
    uint32_t runs;           ///< frames in which it ran
} lobe_profile_times;

typedef struct lobe_profile_summary {
    const lobe_profile_times *passes; ///< that ran at least once, in order of first appearance
    size_t pass_count;
    lobe_profile_times frame; ///< whole frames
    lobe_profile_times host;  ///< CPU time for compiling and recording whole frames; no share
} lobe_profile_summary;

/// Statistics of all frames so far; all 0 if there are none. Pointers are valid until the next call
/// with this profile. Errors: LOBE_ERROR_OUT_OF_MEMORY; the summary then has no passes and no
/// frames.
LOBE_API lobe_result lobe_profile_statistics(lobe_profile *profile, lobe_profile_summary *summary);

#ifdef __cplusplus
}
#endif

#endif
