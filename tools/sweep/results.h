#ifndef TOOLS_SWEEP_RESULTS_H
#define TOOLS_SWEEP_RESULTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "tools/compare/error_metrics.h"

/// What a sweep of the benchmark measures: every filter, over the values of its knobs, in every
/// scene. `lobe bench --sweep` writes it, `lobe report` draws it, `lobe render --budget` and
/// `--error` choose by it. As JSON each structure is an object with members of the same names, an
/// array is a list without its count. JSON has no infinity: a number that is not finite is null
/// there, and read as NAN. Of other numbers six digits are kept, of whole numbers all.

/// All passes of one name in a frame.
typedef struct sweep_pass {
    char name[64];
    double milliseconds; ///< median over the frames
    uint32_t count;
    bool building; ///< builds maps; else it is paid in every frame
    bool once;     ///< prepares the environment: once, whatever maps are built
    /// Bytes that the pass must read and write, each texel once; 0 where that is not known.
    double bytes;
    /// A plain device copy that reads and writes as many bytes together, in the same run; 0: none.
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
    /// The knob whose value is not the default (another may have been set that it needs, see
    /// lobe_knob.sweep_with); "" in the row of the defaults.
    char varied[32];
    // Milliseconds, medians and 95th percentiles over the frames.
    double rebuilt_ms, rebuilt_p95_ms;   ///< every map of materials built in the frame
    double retained_ms, retained_p95_ms; ///< no map built
    double building_ms, shading_ms;      ///< parts of rebuilt_ms: passes that build, all others
    double environment_ms;               ///< passes that prepare the environment, in none of them
    sweep_pass *passes;                  ///< of a frame in which every map is built
    size_t pass_count;
    uint64_t memory_bytes;         ///< most device memory in use: scene, maps and frame
    double bytes_per_texel;        ///< of filtered maps, for each texel of base maps; 0: no maps
    error_metrics error;           ///< of the still picture against the reference
    error_metrics error_lobe_base; ///< against one whose base lobes were converted first
    /// Along the path: |(a' - a) - (r' - r)| / |r|, relative L2 over all pairs of frames, a and a'
    /// the filter's, r and r' the reference's, its noise left out. Negative where it was not
    /// measured.
    double flicker;
    /// EXR file of the still picture, relative to the JSON file; NULL where none was kept.
    char *picture;
} sweep_row;

typedef struct sweep_scene {
    char *name;        ///< unique in the results: the scene's, or "tablecloth in courtyard"
    char *scene;       ///< as the user gave it; NULL: `name` is that
    char *environment; ///< that lights it: its file or "sky"; NULL: none does
    char *lighting;    ///< how options changed the light, see scene_options_describe; NULL: not
    uint64_t triangles;
    /// What chance leaves in the reference: relative L2 distance from its limit at infinitely many
    /// samples. NAN: not known. A row's error without it is the root of error^2 - noise^2.
    double noise;
    char *reference; ///< EXR file of the reference, relative to the JSON file; NULL: none
    char *skipped;   ///< why the scene was not measured; NULL: it was
} sweep_scene;

typedef struct sweep_results {
    char *version;                            ///< of lobe
    char *device, *driver, *device_type;      ///< as lobe_device_describe has them
    uint32_t size[2];                         ///< pixels
    uint32_t reference_samples, path_samples; ///< a pixel
    uint32_t stations;                        ///< pairs of frames along the path
    uint32_t frames;                          ///< timed of each row
    bool complete;                            ///< false: it was interrupted, and can go on
    sweep_scene *scenes;
    size_t scene_count;
    sweep_row *rows; ///< those of a scene stand together, a filter's defaults before its others
    size_t row_count;
} sweep_results;

/// Reads what sweep_results_write wrote; unknown members are passed over. On failure `*results` is
/// zero. Free with sweep_results_free.
/// Errors: LOBE_ERROR_NOT_FOUND, LOBE_ERROR_READ, LOBE_ERROR_MALFORMED (the line names the file
/// and the member), LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_results_read(const char *path, const lobe_host *host, sweep_results *results);

/// Writes JSON, whole or not at all. Errors: LOBE_ERROR_WRITE, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result sweep_results_write(const char *path, const sweep_results *results,
                                const lobe_host *host);

/// Frees all that `*results` points to, each text and list a block of malloc, and zeroes it.
void sweep_results_free(sweep_results *results);
/// The same for one of its parts.
void sweep_row_free(sweep_row *row);
void sweep_scene_free(sweep_scene *scene);

/// A scene by name; NULL where there is none.
const sweep_scene *sweep_results_scene(const sweep_results *results, const char *name);

/// Whether the entry is of this scene, lit by this environment (NULL: by none) and in this way.
bool sweep_scene_is(const sweep_scene *entry, const char *scene, const char *environment,
                    const char *lighting);

/// A row's relative L2 error without what chance has left in its scene's reference; 0 where it is
/// not larger.
double sweep_error_without_noise(const sweep_scene *scene, const sweep_row *row);

/// The value of a row's knob; NULL: it has no such knob.
const char *sweep_row_value(const sweep_row *row, const char *knob);

/// The row of a scene and filter at its defaults; NULL where there is none.
const sweep_row *sweep_results_default(const sweep_results *results, const char *scene,
                                       const char *filter);

/// The row with exactly these settings, in any order; NULL where there is none.
const sweep_row *sweep_results_row(const sweep_results *results, const char *scene,
                                   const char *filter, const sweep_setting *settings,
                                   size_t setting_count);

#endif
