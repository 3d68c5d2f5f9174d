#ifndef TOOLS_BENCH_H
#define TOOLS_BENCH_H

#include <lobe/device.h>
#include <lobe/filter.h>
#include <lobe/profile.h>
#include <lobe/scene.h>

#include "tools/animation/animation.h"
#include "tools/cli/progress.h"
#include "tools/compare/error_metrics.h"

#define BENCH_MAXIMUM_FILTERS 32
/// Samples per pixel of the filter reference when it is measured like any other filter.
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
    /// The settings of the reference that errors are measured against; and of a reference with base
    /// lobes of the filters' own kind, against which only the error of the filtering remains.
    lobe_settings truth, truth_lobe_base;
    uint32_t size[2];
    uint32_t frames;
    uint32_t samples; ///< per pixel of the references
    /// Of the scene that is being measured, which sets it. NULL: that scene stands still.
    animation *animation;
} bench_job;

enum { BENCH_REBUILT, BENCH_RETAINED, BENCH_CHANGED, BENCH_CHANGED_COST, BENCH_PROFILES };

/// One filter in one scene.
typedef struct bench_result {
    const char *scene;
    const bench_filter *filter;
    /// Frames in which every map is rebuilt, frames in which none is, frames after the texels of
    /// all maps changed, and what those cost in all (changed_frame.h). The profiles own what the
    /// summaries point to.
    lobe_profile *profiles[BENCH_PROFILES];
    lobe_profile_summary rebuilt, retained, changed, changed_cost;
    uint64_t memory_bytes;  ///< peak device memory in use for the scene, its maps and the frame
    double bytes_per_texel; ///< of filtered maps, per texel of base maps; 0: no maps
    error_metrics error, error_lobe_base;
} bench_result;

/// Measures all filters of the job in a scene, one result each (zeroed before; free each with
/// bench_result_free, also after a failure). Frames of the filters alternate, so that anything that
/// slows the machine down temporarily affects them all. Moves the scene's texels.
lobe_result bench_measure(const bench_job *job, lobe_scene *scene, const char *name,
                          bench_result *results);
void bench_result_free(bench_result *result);

/// Number of timed frames of a filter: few for one that takes many samples.
uint32_t bench_frames(const bench_job *job, const bench_filter *filter);

/// Prints tables on standard output.
void bench_print(const bench_job *job, const bench_result *results, size_t count);

/// JSON, to be freed with free(); NULL if memory runs out.
char *bench_describe(const bench_job *job, const bench_result *results, size_t count);

#endif
