#ifndef TOOLS_SWEEP_RESULTS_H
#define TOOLS_SWEEP_RESULTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "tools/compare/error_metrics.h"

/// The measurements of a sweep: every filter, over the values of its knobs, in every scene. `lobe
/// bench --sweep` writes them, `lobe report` draws them, and `lobe render --budget` and `--error`
/// use them to pick a filter. In JSON each structure is an object with members of the same names,
/// and an array is a list without its count. JSON has no infinity: a number that is not finite is
/// null there, and read as NAN. Other numbers keep six digits, whole numbers all.

/// All passes of one name in a frame.
typedef struct sweep_pass {
    char name[64];
    double milliseconds; ///< median over the frames
    uint32_t count;
    bool building; ///< builds maps; otherwise it runs in every frame
    bool once;     ///< prepares the environment: once, independent of the maps
    /// Bytes that the pass must read and write, each texel once; 0: unknown.
    double bytes;
    /// Time of a plain device copy that reads and writes as many bytes, in the same run; 0: none.
    double copy_milliseconds;
} sweep_pass;

/// A knob and its value, as a user would write them.
typedef struct sweep_setting {
    char name[32], value[32];
} sweep_setting;

/// One filter with one choice of knobs in one scene.
typedef struct sweep_row {
    char *scene;
    char *filter;
    sweep_setting *settings; ///< every knob of the filter
    size_t setting_count;
    /// The knob whose value is not the default (another knob that it needs may be set, too, see
    /// lobe_knob.sweep_with); "" in the row of the defaults.
    char varied[32];
    // Milliseconds, medians and 95th percentiles over the frames.
    double rebuilt_ms, rebuilt_p95_ms;   ///< every map of materials built in the frame
    double retained_ms, retained_p95_ms; ///< no map built
    double building_ms, shading_ms;      ///< parts of rebuilt_ms: passes that build, all others
    /// After the texels of all maps changed: time of the device, and of both calls in all, as in
    /// tools/bench/changed_frame.h. NAN: not measured.
    double changed_ms, changed_wall_ms, changed_caller_cpu_ms, changed_process_cpu_ms;
    double environment_ms; ///< passes that prepare the environment, in none of them
    sweep_pass *passes;    ///< of a frame in which every map is built
    size_t pass_count;
    uint64_t memory_bytes;         ///< most device memory in use: scene, maps and frame
    double bytes_per_texel;        ///< of filtered maps, for each texel of base maps; 0: no maps
    error_metrics error;           ///< of the still picture against the reference
    error_metrics error_lobe_base; ///< against one whose base lobes were converted first
    /// Of `error`, over the pixels inside surfaces and over those along silhouettes (see
    /// tools/compare/silhouettes.h), without the reference's noise. NAN: none, or not measured.
    double inside_relative_l2, silhouettes_relative_l2;
    /// Along the path: |(a' - a) - (r' - r)| / |r|, relative L2 over all pairs of frames, with a
    /// and a' of the filter, r and r' of the reference, without the reference's noise. Negative:
    /// not measured.
    double flicker;
    /// EXR file of the still picture, relative to the JSON file; NULL: none.
    char *picture;
} sweep_row;

/// What plain supersampling with the filter reference reaches.
typedef struct sweep_supersampling {
    uint32_t samples;   ///< per pixel
    double relative_l2; ///< against the scene's reference, without its noise
} sweep_supersampling;

typedef struct sweep_scene {
    char *name;        ///< unique in the results: the scene's, or "tablecloth in courtyard"
    char *scene;       ///< as given by the user; NULL: the same as `name`
    char *environment; ///< that lights it: its file or "sky"; NULL: none
    char *lighting; ///< how options changed the light, see scene_options_describe; NULL: unchanged
    uint64_t triangles;
    /// Noise in the reference: relative L2 distance from its limit at infinitely many samples. NAN:
    /// unknown. A row's error without it is the root of error^2 - noise^2.
    double noise;
    sweep_supersampling *supersampling; ///< with more and more samples
    size_t supersampling_count;         ///< 0: not measured
    char *reference; ///< EXR file of the reference, relative to the JSON file; NULL: none
    char *skipped;   ///< why the scene was not measured; NULL: it was
} sweep_scene;

typedef struct sweep_results {
    char *version;                            ///< of lobe
    char *device, *driver, *device_type;      ///< from lobe_device_describe
    uint32_t size[2];                         ///< pixels
    uint32_t reference_samples, path_samples; ///< a pixel
    uint32_t stations;                        ///< pairs of frames along the path
    uint32_t frames;                          ///< timed of each row
    bool complete;                            ///< false: it was interrupted and can be resumed
    sweep_scene *scenes;
    size_t scene_count;
    sweep_row *rows; ///< grouped by scene; a filter's defaults come first
    size_t row_count;
} sweep_results;

/// Reads a file written by sweep_results_write; unknown members are ignored. On failure `*results`
/// is zero. Free with sweep_results_free. Errors: LOBE_ERROR_NOT_FOUND, LOBE_ERROR_READ,
/// LOBE_ERROR_MALFORMED (the message names the file and the member), LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_results_read(const char *path, const lobe_host *host, sweep_results *results);

/// Writes JSON, completely or not at all. Errors: LOBE_ERROR_WRITE, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_results_write(const char *path, const sweep_results *results,
                                const lobe_host *host);

/// Frees everything that `*results` points to, each text and list allocated by malloc, and zeroes
/// it.
void sweep_results_free(sweep_results *results);
/// The same for one of its parts.
void sweep_row_free(sweep_row *row);
void sweep_scene_free(sweep_scene *scene);

/// A scene by name; NULL if there is none.
const sweep_scene *sweep_results_scene(const sweep_results *results, const char *name);

/// Whether the entry is of this scene, lit by this environment (NULL: by none) and in this way.
bool sweep_scene_is(const sweep_scene *entry, const char *scene, const char *environment,
                    const char *lighting);

/// A relative L2 error without the noise (NAN: unknown) in the reference; 0 if it is not larger.
double sweep_without_noise(double error, double noise);
/// That of a row, over the whole picture.
double sweep_error_without_noise(const sweep_scene *scene, const sweep_row *row);

/// A row's worth in samples: how many samples per pixel supersampling needs for the same error,
/// interpolated between those measured (straight lines of logarithms). The largest number measured
/// if the row is better than that; below 1 if it is worse than one sample, as if errors fell as
/// the root of the number. NAN: not measured.
double sweep_worth_in_samples(const sweep_scene *scene, const sweep_row *row);

/// The time that supersampling takes for the same error, over that of the row with maps retained.
/// NAN: not measured, or the results have no row of the filter reference.
double sweep_gain_in_time(const sweep_results *results, const sweep_scene *scene,
                          const sweep_row *row);

/// The value of a row's knob; NULL if it has no such knob.
const char *sweep_row_value(const sweep_row *row, const char *knob);

/// The row with exactly these settings, in any order; NULL if there is none.
const sweep_row *sweep_results_row(const sweep_results *results, const char *scene,
                                   const char *filter, const sweep_setting *settings,
                                   size_t setting_count);

#endif
