#ifndef TOOLS_COMPARE_FLIP_EXPOSURES_H
#define TOOLS_COMPARE_FLIP_EXPOSURES_H

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// The range of exposures over which FLIP compares images of high dynamic range.

/// Exposures in stops, from `start` in `count` even steps to `stop`.
typedef struct flip_exposures {
    double start, stop;
    unsigned count;
} flip_exposures;

/// The range for a linear RGBA32_FLOAT image. LOBE_ERROR_OUT_OF_MEMORY.
lobe_result flip_choose_exposures(const lobe_image *reference, const lobe_host *host,
                                  flip_exposures *exposures);

/// Radiance times `gain` to [0, 1], as FLIP assumes it is shown. Negative values and NaN give 0.
float flip_tone_map(float radiance, float gain);

#endif
