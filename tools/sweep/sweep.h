#ifndef TOOLS_SWEEP_H
#define TOOLS_SWEEP_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/filter.h>
#include <lobe/renderer.h>

#include "tools/bench/bench.h"
#include "tools/cli/scene_options.h"
#include "tools/compare/silhouettes.h"
#include "tools/sweep/results.h"

/// `lobe bench --sweep`: declarations shared by its files.
///
///     sweep.c      measures subjects one after the other, writes results after each
///     job.c        what every part needs to render
///     subject.c    a scene in an environment: its name, and a check of earlier results
///     plan.c       which rows there are
///     truth.c      references, and the error of supersampling
///     parts.c      errors inside surfaces and along silhouettes
///     measure.c    all rows of one scene; scene_run.h lists its parts
///     flicker.c    change along the scene's path
///     bandwidth.c  plain copies of as many bytes as passes move
///     pictures.c   names and files of pictures
///     print.c      a table for people
///     results.c    the file; lookup.c finds rows in it

/// A row to measure: a filter and its knobs.
typedef struct sweep_variant {
    bench_filter filter;
    /// The knob that is varied; "" for none. All others are at their defaults, except those it
    /// requires (lobe_knob.sweep_with).
    const char *varied;
} sweep_variant;

typedef struct sweep_plan {
    sweep_variant *variants; ///< a filter's defaults come first
    size_t count;
} sweep_plan;

/// A scene in an environment.
typedef struct sweep_subject {
    char *name;              ///< in the results: "tablecloth in courtyard"
    const char *scene;       ///< as given by the user
    const char *environment; ///< a file, "sky" or "none"; NULL: the scene's own
} sweep_subject;

/// A sweep that measures only times of one kind of frame, and the error of the still picture: no
/// pictures, no copies, no reference with converted base lobes.
typedef struct sweep_brief {
    bool retained; ///< times frames with maps retained, else with all maps rebuilt
    /// Whether to measure row `index`, which varies a knob. The rows of all filters at their
    /// defaults have been measured before.
    bool (*wants)(void *user, const sweep_row *rows, size_t index);
    void *user;
} sweep_brief;

typedef struct sweep_job {
    bench_job bench;
    sweep_plan plan;             ///< for scenes without an environment; for the current one
    sweep_plan environment_plan; ///< for those with one
    const char *json;
    const char *pictures; ///< folder; NULL: beside the JSON
    char *picture_folder; ///< where pictures are written
    char *picture_prefix; ///< the same as seen from the JSON's folder, with a slash
    const scene_options *opening;
    const char *knobs; ///< to vary, "a,b,c"; NULL: all
    uint32_t path_samples, stations;
    const sweep_brief *brief; ///< NULL: a whole sweep; otherwise `stations` must be 0
    bool resume;
    const volatile sig_atomic_t *interrupted; ///< not 0: stop soon
} sweep_job;

/// Measures every scene in every environment (in its own if none are given) and prints a table.
/// Writes the JSON after each. A scene that does not open is recorded as skipped. `bench.filters`
/// and the references must be set. `opening` states the other options of the light. Also returns
/// LOBE_OK when interrupted. Errors: LOBE_ERROR_NOT_FOUND (every scene was skipped),
/// LOBE_ERROR_INVALID_ARGUMENT (the results to resume were measured differently; two environments
/// have the same name), LOBE_ERROR_WRITE, those of reading results and of rendering.
lobe_result sweep_run(sweep_job *job, const option_list *scenes, const option_list *environments);

/// Whether to stop. Steps then return LOBE_OK, with results to be discarded.
bool sweep_stopped(const sweep_job *job);

/// Parameters for a frame of a variant: discarded, 64 samples if it supersamples, stopped by
/// Ctrl-C.
lobe_render_parameters sweep_parameters(const sweep_job *job, const sweep_variant *variant);

/// For frames that are a step by themselves: shows the fraction done. `user` is the job.
bool sweep_show_progress(void *user, double part);

// ---------------------------------------------------------------------------------------------
// plan.c

typedef struct sweep_plan_request {
    const bench_filter *filters;
    size_t filter_count;
    bool environment;  ///< also varies knobs that only matter with an environment
    const char *knobs; ///< "a,b,c": varies only these; NULL: all
} sweep_plan_request;

/// Each filter with its defaults, and once with each value in each knob's list `sweep` that is not
/// the default; a supersampling filter only with its defaults. A repeated filter is ignored. Free
/// with sweep_plan_free. Errors: LOBE_ERROR_INVALID_ARGUMENT (a value that its own knob rejects),
/// LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_plan_make(const sweep_plan_request *request, const lobe_host *host,
                            sweep_plan *plan);
void sweep_plan_free(sweep_plan *plan);

/// Whether a request's `knobs` contains the name.
bool sweep_plan_lists(const char *knobs, const char *knob);

/// Every knob of a variant as text, into at most LOBE_MAXIMUM_KNOBS; their number.
size_t sweep_variant_settings(const sweep_variant *variant, sweep_setting *settings);

// ---------------------------------------------------------------------------------------------
// subject.c

/// Every scene in every environment, scene by scene. Free with sweep_subjects_free, also after a
/// failure. Errors: LOBE_ERROR_INVALID_ARGUMENT (two would have the same name),
/// LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_subjects_list(const option_list *scenes, const option_list *environments,
                                const lobe_host *host, sweep_subject **subjects, size_t *count);
void sweep_subjects_free(sweep_subject **subjects, size_t count);

/// Whether it is known to have an environment before it is opened.
bool sweep_subject_has_environment(const sweep_subject *subject);

/// Checks that results of that name are of the same scene in the same environment, in the same
/// light. Errors: LOBE_ERROR_INVALID_ARGUMENT.
lobe_result sweep_subject_check(const sweep_job *job, const sweep_subject *subject,
                                const sweep_scene *former);

// ---------------------------------------------------------------------------------------------
// truth.c

/// The references of a scene.
typedef struct sweep_truth {
    lobe_image image, lobe_base; ///< the second with base lobes converted; empty in brief sweeps
    bool *pixels[COMPARE_PART_COUNT]; ///< of each part; NULL: all, none, or a brief sweep
    double noise[COMPARE_PART_COUNT]; ///< in `image`, over each part, as in sweep_scene
} sweep_truth;

/// Work of sweep_truth_render, in the unit of progress_expect: frames of one sample.
double sweep_truth_work(const sweep_job *job);

/// Renders the references; `entry` gets picture, noise and, unless the sweep is brief, the error of
/// supersampling. Free with sweep_truth_free, also after a failure.
lobe_result sweep_truth_render(const sweep_job *job, const lobe_scene *scene,
                               lobe_renderer *renderer, sweep_scene *entry, sweep_truth *truth);
void sweep_truth_free(sweep_truth *truth);

// ---------------------------------------------------------------------------------------------
// parts.c

/// Finds the parts of the reference from its `normal_depth`, which is overwritten.
lobe_result sweep_parts_find(const sweep_job *job, lobe_image *normal_depth, sweep_truth *truth);
void sweep_parts_free(sweep_truth *truth);

/// Measures a row's errors over the parts.
lobe_result sweep_parts_measure(const sweep_job *job, const lobe_image *image,
                                const sweep_truth *truth, sweep_row *row);

// ---------------------------------------------------------------------------------------------
// measure.c

/// Work of sweep_measure for a scene, in the unit of progress_expect: frames of one sample.
double sweep_scene_work(const sweep_job *job);

/// Measures all variants in a scene. `rows` has room for all, zeroed; free them also after a
/// failure. `entry` gets the reference's picture and noise.
///
/// In every round each row has a turn in one renderer: a frame with its maps rebuilt that only
/// warms up (switching between rows frees and allocates maps, and on a CPU memory is slow when
/// first touched), timed frames with maps rebuilt, the same with maps retained, and the same after
/// all texels changed, which leaves the scene's texels moved. So only one row's maps are on the
/// device at a time, however many rows there are, and yet the frames of all rows are spread over
/// the same minutes. A brief sweep times a row's frames after its still instead, and frames of more
/// than half a second once; rows that it does not want keep times and errors of 0.
lobe_result sweep_measure(const sweep_job *job, lobe_scene *scene, sweep_scene *entry,
                          sweep_row *rows);

// ---------------------------------------------------------------------------------------------
// flicker.c

/// The change of the reference at the stations of a scene's path.
typedef struct sweep_path {
    lobe_image *changes[2]; ///< of two references, by station, between two frames
    double squares;         ///< sum over red, green and blue of all first frames
} sweep_path;

/// Renders two references with independent samples, two frames per station. Free with
/// sweep_path_free, also after a failure.
lobe_result sweep_path_render(const sweep_job *job, const lobe_scene *scene,
                              lobe_renderer *renderer, sweep_path *path);
void sweep_path_free(const sweep_job *job, sweep_path *path);

/// See sweep_row.flicker. Sums the products of the filter's excess change over one reference and
/// over the other: the references' common signal remains, while their independent noise cancels; 0
/// if the sum is negative. Negative if the filter supersamples like the reference.
lobe_result sweep_path_flicker(const sweep_job *job, const lobe_scene *scene,
                               lobe_renderer *renderer, const sweep_variant *variant,
                               const sweep_path *path, double *flicker);

// ---------------------------------------------------------------------------------------------
// bandwidth.c

/// Copies on the device, with the sizes that rows' passes move.
typedef struct sweep_copies sweep_copies;

/// One for each different `bytes` of the rows' passes. Free with sweep_copies_destroy.
lobe_result sweep_copies_create(const sweep_job *job, const sweep_row *rows, size_t row_count,
                                sweep_copies **copies);
void sweep_copies_destroy(sweep_copies **copies);

/// Copies each size once more.
lobe_result sweep_copies_time(sweep_copies *copies);

/// Stores the median times of the copies in the passes.
lobe_result sweep_copies_summarise(sweep_copies *copies, sweep_row *rows, size_t row_count);

// ---------------------------------------------------------------------------------------------
// pictures.c

/// Makes the folder for pictures. Errors: LOBE_ERROR_WRITE, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_pictures_open(sweep_job *job);
void sweep_pictures_close(sweep_job *job);

/// Writes a still picture; `*relative` is its name relative to the JSON's folder, to be freed with
/// free().
lobe_result sweep_pictures_write(const sweep_job *job, const char *scene,
                                 const sweep_variant *variant, uint32_t samples, const char *name,
                                 const lobe_frame *frame, char **relative);

// ---------------------------------------------------------------------------------------------
// print.c

void sweep_print(const sweep_results *results);

#endif
