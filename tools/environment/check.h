#ifndef TOOLS_ENVIRONMENT_CHECK_H
#define TOOLS_ENVIRONMENT_CHECK_H

#include <lobe/device.h>
#include <lobe/environment_maps.h>

#include "tools/cli/progress.h"
#include "tools/environment/shaders/check.h"

/// Measures the error of each method of lighting lobes by an environment against the exact
/// integral, and its time.

typedef enum environment_method {
    ENVIRONMENT_PREFILTERED,
    ENVIRONMENT_BLENDED, ///< prefiltered, of two cubes: the knob env_levels
    ENVIRONMENT_MIP,
    ENVIRONMENT_SAMPLED,            ///< filtered importance sampling, 32 samples
    ENVIRONMENT_SAMPLED_EQUAL_TIME, ///< as many as fit into the time of prefiltered, at least one
    ENVIRONMENT_METHOD_COUNT
} environment_method;

/// "prefiltered" and so on.
const char *environment_method_name(environment_method method);

typedef struct environment_error {
    uint32_t samples; ///< of the sampled methods, else 0
    /// Over all directions and channels: |light - exact| / |exact|, Euclidean norms.
    double relative_l2;
    double milliseconds; ///< for all directions; median
} environment_error;

/// Results for one face size.
typedef struct environment_findings {
    uint32_t face; ///< texels per side of a face
    double concentrations[CHECK_LOBES];
    environment_error errors[CHECK_LOBES][ENVIRONMENT_METHOD_COUNT];
    /// Device time of the plain MIP chain, and of all maps: when first made, and when the
    /// environment changes. Medians, without the extra time of `blended`.
    double mip_milliseconds, first_milliseconds, update_milliseconds;
    uint32_t submissions; ///< into which the first was split
} environment_findings;

typedef struct environment_check_job {
    lobe_device *device;
    const lobe_host *host;
    progress *progress;
    const lobe_environment *environment;
    double kappa;        ///< of the broadest lobe; each next one has four times as much
    uint32_t directions; ///< spread over the sphere
    uint32_t rounds;     ///< whose median is taken
} environment_check_job;

lobe_result environment_check_run(const environment_check_job *job, uint32_t face,
                                  environment_findings *findings);

/// Prints a table on standard output.
void environment_check_print(const environment_findings *findings);

/// Writes the results for several sizes as JSON.
lobe_result environment_check_write(const char *path, const environment_check_job *job,
                                    const environment_findings *findings, size_t count);

#endif
