#ifndef TOOLS_SWEEP_SCENE_RUN_H
#define TOOLS_SWEEP_SCENE_RUN_H

#include "tools/sweep/sweep.h"

/// The measurements of one scene: what the files behind sweep_measure share.
///
///     still.c     passes, memory, error and flicker of a row
///     times.c     times of a row's frames
///     rows.c      names rows, and summarises their times

typedef struct row_times {
    lobe_profile *rebuilt, *retained, *parts, *changed, *changed_cost;
} row_times;

/// State of the measurements of one scene.
typedef struct scene_run {
    const sweep_job *job;
    lobe_scene *scene;
    const char *name; ///< in the results
    lobe_host errors; ///< only errors pass: a filter's warnings should not repeat
    sweep_row *rows;
    row_times *times; ///< one per row
    sweep_truth truth;
    sweep_path path;
} scene_run;

/// Logs that memory is exhausted.
lobe_result scene_run_out_of_memory(const scene_run *run);

/// A renderer of the scene. Destroy it also after a failure.
lobe_result scene_run_renderer(const scene_run *run, const lobe_host *host,
                               lobe_renderer **renderer);

/// Samples of a variant's timed frames.
uint32_t scene_run_samples(const sweep_variant *variant);

/// NULL if the frame has no such pass.
const lobe_pass_time *scene_run_find_pass(const lobe_frame *frame, const char *name);

// Work is in the unit of progress_expect: frames of one sample.

double still_work(const sweep_job *job, const sweep_variant *variant);
double times_work(const sweep_job *job, const sweep_variant *variant);

/// Opens `*renderer` if it is NULL. Its maps are then those of the row.
lobe_result still_measure(const scene_run *run, const sweep_variant *variant,
                          lobe_renderer **renderer, sweep_row *row);

/// Times of all rows, as sweep_measure describes.
lobe_result times_measure(const scene_run *run);

/// Times of one row of a brief sweep, in a renderer that has just drawn its still.
lobe_result times_measure_briefly(const scene_run *run, lobe_renderer *renderer, size_t index);

/// Names all rows and makes their profiles. Close also after a failure.
lobe_result rows_open(scene_run *run, const char *scene);
void rows_close(scene_run *run);

/// Medians of a row's times.
lobe_result rows_summarise_row(const scene_run *run, size_t index);

/// The same of all rows, and the time that preparing the environment took.
lobe_result rows_summarise(const scene_run *run);

#endif
