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
#include "tools/sweep/results.h"

/// `lobe bench --sweep`: what its parts share. One file does one thing:
///
///     sweep.c            subjects one after the other, results written after each
///     sweep_subject.c    a scene in an environment: its name, and who it was before
///     sweep_plan.c       which rows there are
///     sweep_measure.c    all rows of one scene
///     sweep_flicker.c    change along the scene's path
///     sweep_bandwidth.c  plain copies of as many bytes as passes move
///     sweep_pictures.c   names and files of pictures
///     sweep_print.c      a table for people
///     sweep_results.c    the file

/// A row to measure: a filter and its knobs.
typedef struct sweep_variant {
    bench_filter filter;
    /// The knob that is gone through; "" for none. All others are at their defaults, but for what
    /// it needs beside it (lobe_knob.sweep_with).
    const char *varied;
} sweep_variant;

typedef struct sweep_plan {
    sweep_variant *variants; ///< a filter's defaults stand before its others
    size_t count;
} sweep_plan;

/// A scene in an environment.
typedef struct sweep_subject {
    char *name;              ///< "tablecloth in courtyard": what results know it by
    const char *scene;       ///< as the user gave it
    const char *environment; ///< a file, "sky" or "none"; NULL: the scene's own
} sweep_subject;

typedef struct sweep_job {
    bench_job bench;
    sweep_plan plan;             ///< of scenes without an environment; of the one that is measured
    sweep_plan environment_plan; ///< of those with one
    const char *json;
    const char *pictures; ///< folder; NULL: beside the JSON
    char *picture_folder; ///< where they go
    char *picture_prefix; ///< the same as seen from the JSON's folder, with a slash
    const scene_options *opening;
    const char *knobs; ///< to go through, "a,b,c"; NULL: all
    uint32_t path_samples, stations;
    /// Measures no more than times and the error of the still picture against the truth: no
    /// pictures, no copies, no truth with converted base lobes; then `stations` is 0.
    bool brief;
    bool resume;
    const volatile sig_atomic_t *interrupted; ///< not 0: stop soon
} sweep_job;

/// Measures every scene in every environment (in its own where none are given) and prints a table.
/// Writes the JSON after each. A scene that does not open is entered as skipped. `bench.filters`
/// and truths must be chosen. `opening` says how scenes are lit else. LOBE_OK too where it was
/// interrupted. Errors: LOBE_ERROR_NOT_FOUND (every scene was skipped), LOBE_ERROR_INVALID_ARGUMENT
/// (results to go on from were measured otherwise; two environments called alike),
/// LOBE_ERROR_WRITE, those of reading results and of rendering.
lobe_result sweep_run(sweep_job *job, const option_list *scenes, const option_list *environments);

/// Whether to stop. Steps then return LOBE_OK, with results to throw away.
bool sweep_stopped(const sweep_job *job);

/// A frame of a variant: discarded, 64 samples where it supersamples, stopped by Ctrl-C.
lobe_render_parameters sweep_parameters(const sweep_job *job, const sweep_variant *variant);

/// For frames that are a step of their own: shows the part that is done. `user` is the job.
bool sweep_show_progress(void *user, double part);

// ---------------------------------------------------------------------------------------------
// sweep_plan.c

typedef struct sweep_plan_request {
    const bench_filter *filters;
    size_t filter_count;
    bool environment;  ///< goes through knobs that tell in an environment alone too
    const char *knobs; ///< "a,b,c": goes through these alone; NULL: through all
} sweep_plan_request;

/// Each filter with its defaults, and once with each value of each knob's list `sweep` that is not
/// the default; a supersampling filter only with its defaults. Of a filter given twice the second
/// is passed over. Free with sweep_plan_free. Errors: LOBE_ERROR_INVALID_ARGUMENT (a value that its
/// own knob refuses), LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_plan_make(const sweep_plan_request *request, const lobe_host *host,
                            sweep_plan *plan);
void sweep_plan_free(sweep_plan *plan);

/// Whether a request's `knobs` has the name.
bool sweep_plan_lists(const char *knobs, const char *knob);

/// Every knob of a variant as text, into at most LOBE_MAXIMUM_KNOBS; their number.
size_t sweep_variant_settings(const sweep_variant *variant, sweep_setting *settings);

// ---------------------------------------------------------------------------------------------
// sweep_subject.c

/// Every scene in every environment, scene by scene. Free with sweep_subjects_free, after a failure
/// too. Errors: LOBE_ERROR_INVALID_ARGUMENT (two would have one name), LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_subjects_list(const option_list *scenes, const option_list *environments,
                                const lobe_host *host, sweep_subject **subjects, size_t *count);
void sweep_subjects_free(sweep_subject **subjects, size_t count);

/// Whether it can be known to have an environment before it is opened.
bool sweep_subject_has_environment(const sweep_subject *subject);

/// Results of that name are of the same scene in the same environment, lit likewise.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT.
lobe_result sweep_subject_check(const sweep_job *job, const sweep_subject *subject,
                                const sweep_scene *former);

// ---------------------------------------------------------------------------------------------
// sweep_measure.c

/// Work of sweep_measure for a scene, in the unit of progress_expect: frames of one sample.
double sweep_scene_work(const sweep_job *job);

/// Measures all variants in a scene. `rows` has room for all, zeroed; free them after a failure
/// too. `entry` gets the reference's picture and noise.
///
/// Every round gives each row a turn in one renderer: a frame with its maps built that only warms
/// up (switching from row to row frees and allocates maps, and on a CPU memory is paid for when it
/// is first touched), frames with maps built that are timed, and the same with maps retained. So
/// one row's maps are all there is on the device at a time, however many rows there are, and yet
/// all rows' frames are spread over the same minutes.
lobe_result sweep_measure(const sweep_job *job, const lobe_scene *scene, sweep_scene *entry,
                          sweep_row *rows);

// ---------------------------------------------------------------------------------------------
// sweep_flicker.c

/// What the reference does at the stations of a scene's path.
typedef struct sweep_path {
    lobe_image *changes[2]; ///< of two references, by station: from one frame to the next
    double squares;         ///< of all first frames' red, green and blue
} sweep_path;

/// Renders two references of independent samples: two frames a station each. Free with
/// sweep_path_free, after a failure too.
lobe_result sweep_path_render(const sweep_job *job, const lobe_scene *scene,
                              lobe_renderer *renderer, sweep_path *path);
void sweep_path_free(const sweep_job *job, sweep_path *path);

/// See sweep_row.flicker. A filter's change beyond one reference's times that beyond the other's:
/// what both references have in common stays, and their noise, which they have not, falls out of
/// the sum; 0 where more than that falls out. Negative where the filter supersamples, as the
/// reference does.
lobe_result sweep_path_flicker(const sweep_job *job, const lobe_scene *scene,
                               lobe_renderer *renderer, const sweep_variant *variant,
                               const sweep_path *path, double *flicker);

// ---------------------------------------------------------------------------------------------
// sweep_bandwidth.c

/// Copies on the device, of the sizes that rows' passes move.
typedef struct sweep_copies sweep_copies;

/// One for each different `bytes` of the rows' passes. Free with sweep_copies_destroy.
lobe_result sweep_copies_create(const sweep_job *job, const sweep_row *rows, size_t row_count,
                                sweep_copies **copies);
void sweep_copies_destroy(sweep_copies **copies);

/// Copies each size once more.
lobe_result sweep_copies_time(sweep_copies *copies);

/// Tells the passes the median of their copies' times.
lobe_result sweep_copies_summarise(sweep_copies *copies, sweep_row *rows, size_t row_count);

// ---------------------------------------------------------------------------------------------
// sweep_pictures.c

/// Makes the folder for pictures. Errors: LOBE_ERROR_WRITE, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_pictures_open(sweep_job *job);
void sweep_pictures_close(sweep_job *job);

/// Writes a still picture; `*relative` is its name as seen from the JSON's folder, to free().
lobe_result sweep_pictures_write(const sweep_job *job, const char *scene,
                                 const sweep_variant *variant, uint32_t samples, const char *name,
                                 const lobe_frame *frame, char **relative);

// ---------------------------------------------------------------------------------------------
// sweep_print.c

void sweep_print(const sweep_results *results);

#endif
