#ifndef TOOLS_CHOICE_CALIBRATION_H
#define TOOLS_CHOICE_CALIBRATION_H

#include <stdint.h>

#include <lobe/device.h>
#include <lobe/scene.h>

#include "tools/choice/trade_choice.h"
#include "tools/sweep/results.h"

/// What is calibrated, for one picture.
typedef struct calibration {
    lobe_device *device;
    const lobe_host *host;
    lobe_scene *scene; ///< with the camera and the lights of the picture
    uint32_t size[2];
    const trade_request *request; ///< of frames of this size
} calibration;

/// A short sweep of one scene: every filter except supersampling ones, with a few frames each; and
/// over the values of the knobs of those filters that may be chosen for the request. Logs that it
/// calibrates, and shows its progress on a terminal.
///
/// `*results` gets the size, samples and frames, and the rows with scene, filter, settings, the
/// requested time and `error`, the relative L2 without the noise of the reference; everything else
/// is empty, and so are time and error of rows that were not measured. Free with
/// sweep_results_free, also after a failure. Errors: LOBE_ERROR_OUT_OF_MEMORY, those of rendering.
lobe_result calibrate(const calibration *calibration, sweep_results *results);

#endif
