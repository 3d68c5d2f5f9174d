#ifndef TOOLS_CHOICE_CALIBRATION_H
#define TOOLS_CHOICE_CALIBRATION_H

#include <stdint.h>

#include <lobe/device.h>
#include <lobe/scene.h>

#include "tools/sweep/results.h"

/// What is calibrated, for one picture.
typedef struct calibration {
    lobe_device *device;
    const lobe_host *host;
    const lobe_scene *scene; ///< with the camera and the lights of the picture
    uint32_t size[2];
} calibration;

/// A short sweep of one scene: every filter over the values of its knobs, but none that
/// supersamples; a few frames each. Says that it calibrates, and on a terminal how far it is.
///
/// `*results` gets the size, samples and frames, and the rows with scene, filter, settings, times
/// and `error`, its relative L2 without the truth's noise; all else is empty. Free with
/// sweep_results_free, after a failure too. Errors: LOBE_ERROR_OUT_OF_MEMORY, those of rendering.
lobe_result calibrate(const calibration *calibration, sweep_results *results);

#endif
