#ifndef TOOLS_BENCH_H
#define TOOLS_BENCH_H

#include <lobe/device.h>
#include <lobe/filter.h>
#include <lobe/profile.h>
#include <lobe/scene.h>

#include "tools/cli/progress.h"
#include "tools/compare/error_metrics.h"

#define BENCH_MAXIMUM_FILTERS 32
/// Samples a pixel of the filter reference where it is measured like any other.
#define BENCH_TIMED_SAMPLES 64

typedef struct bench_filter {
    const lobe_filter *filter;
    lobe_settings settings;
} bench_filter;

/// What is measured, and how.
typedef struct bench_job {
    lobe_device *device;
    const lobe_host *host;
    progress *progress;
    bench_filter filters[BENCH_MAXIMUM_FILTERS];
    size_t filter_count;
    /// The settings of the truth that errors are against; and of the truth with base lobes of the
    /// filters' own kind, against which only the error of the filtering is left.
    lobe_settings truth, truth_lobe_base;
    uint32_t size[2];
    uint32_t frames;
    uint32_t samples; ///< of the truths
} bench_job;

/// One filter in one scene.
typedef struct bench_result {
    const char *scene;
    const bench_filter *filter;
    /// Every map built again in each frame; or none. The profiles own what the summaries point to.
    lobe_profile *profiles[2];
    lobe_profile_summary rebuilt, retained;
    uint64_t memory_bytes;  ///< most device memory in use for the scene, its maps and the frame
    double bytes_per_texel; ///< of filtered maps, for each texel of base maps; 0: no maps
    error_metrics error, error_lobe_base;
} bench_result;

/// Measures all filters of the job in a scene, into as many results (zeroed before; free each with
/// bench_result_free, after a failure too). Frames of the filters take turns, so that what slows
/// the machine down for a while slows them all.
lobe_result bench_measure(const bench_job *job, const lobe_scene *scene, const char *name,
                          bench_result *results);
void bench_result_free(bench_result *result);

/// Frames of a filter that are timed: of one that takes many samples at most a few.
uint32_t bench_frames(const bench_job *job, const bench_filter *filter);

/// Tables for people, on standard output.
void bench_print(const bench_job *job, const bench_result *results, size_t count);

/// JSON, to free() by the caller; NULL without memory.
char *bench_describe(const bench_job *job, const bench_result *results, size_t count);

#endif
