#ifndef TOOLS_CHOICE_BUDGET_H
#define TOOLS_CHOICE_BUDGET_H

#include <lobe/device.h>
#include <lobe/filter.h>
#include <lobe/scene.h>

#include "tools/choice/budget_options.h"
#include "tools/sweep/results.h"

/// `lobe render --budget` and `--error`: filter and knobs for one picture.
///
///     trade_choice.c  which row of a sweep
///     calibration.c   a short sweep if there is no stored one

/// What is to be rendered.
typedef struct budget_picture {
    const char *name;     ///< of the scene, as given by the user
    lobe_scene *scene;    ///< with its environment
    const char *lighting; ///< see scene_options_describe
    bool own_view;        ///< camera and lights are the scene's own
    lobe_device *device;
    uint32_t size[2];
} budget_picture;

/// Reads the stored sweep, if the options name one, and finds the scene in it, in whatever light;
/// otherwise `*figures` is zero. Free with sweep_results_free. Errors: LOBE_ERROR_INVALID_ARGUMENT
/// (the sweep has not measured the scene), those of sweep_results_read.
lobe_result budget_read(const budget_options *options, const char *scene, const lobe_host *host,
                        sweep_results *figures);

/// Picks filter and knobs, and prints the choice and the reason on standard output. Calibrates
/// first if the options name no sweep. The filter never supersamples. Errors:
/// LOBE_ERROR_INVALID_ARGUMENT (the sweep was made on another device, or has not measured the scene
/// in its environment), LOBE_ERROR_UNSUPPORTED (nothing is within the limit; the message says what
/// comes nearest), those of calibrate.
lobe_result budget_pick(const budget_options *options, const budget_picture *picture,
                        const lobe_host *host, sweep_results *figures, const lobe_filter **filter,
                        lobe_settings *settings);

#endif
