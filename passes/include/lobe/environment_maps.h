#ifndef LOBE_ENVIRONMENT_MAPS_H
#define LOBE_ENVIRONMENT_MAPS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/device.h>
#include <lobe/environment.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/renderer.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The maps with which an environment lights lobes, without a renderer: for tools that inspect,
/// store or time them. A renderer makes its own.
///
/// All maps are cubes of RGBA32_FLOAT, with faces in the order +X -X +Y -Y +Z -Z, oriented as in
/// Vulkan. They are in the environment's own space, without its rotation and intensity. Alpha is 1.
///
/// Not thread-safe: use an object in one thread at a time.
typedef struct lobe_environment_maps lobe_environment_maps;

typedef enum lobe_environment_map {
    /// The radiance itself, and its means over larger and larger texels down to 1x1: every level
    /// has the energy of level 0. A lobe's exact light is the sum over the texels of level 0 of
    /// radiance * solid angle * lobe at the texel's centre.
    LOBE_ENVIRONMENT_RADIANCE,
    /// Each level filtered with a von Mises-Fisher lobe about the direction; from one level to the
    /// next the concentration falls to a quarter.
    LOBE_ENVIRONMENT_VON_MISES_FISHER,
    /// The same levels with GGX lobes, proportional to D(theta/2) of alpha^2 = 1/(2 kappa), where
    /// theta is the angle to the direction and kappa the level's concentration; alpha is at most 1.
    LOBE_ENVIRONMENT_GGX,
    /// The same levels with von Mises-Fisher lobes of twice the concentration, half way between
    /// those of LOBE_ENVIRONMENT_VON_MISES_FISHER: blending one level of each is closer to the
    /// wanted lobe.
    LOBE_ENVIRONMENT_BETWEEN,
    LOBE_ENVIRONMENT_MAP_COUNT
} lobe_environment_map;

typedef struct lobe_environment_maps_parameters {
    const lobe_environment *environment; ///< copied to the device before the call returns
    /// Texels along a face of the radiance: a power of two in [16, 2048]; 0: 256.
    uint32_t size;
    bool wanted[LOBE_ENVIRONMENT_MAP_COUNT]; ///< the radiance is always made
    /// Most parts of the work to do in one submission, so that the device can do other work in
    /// between; 0: all in one submission.
    uint32_t parts_per_submission;
    /// An existing folder that caches filtered cubes, as OpenEXR files named after what they were
    /// made from: cubes that are found are not made, others are saved. A damaged or foreign file is
    /// replaced, with a notice. Logs a warning if the folder is not writable. Files may be removed
    /// at any time. NULL: nothing is read or written. Copied.
    const char *cache;
    /// Called between submissions with the fraction done, [0, 1]; returning false stops with
    /// LOBE_OK and no maps. NULL: none.
    bool (*progress)(void *user, double part);
    void *user;
    const lobe_host *host; ///< copied; NULL: silent. Memory comes from the device's allocator.
} lobe_environment_maps_parameters;

/// Makes the maps and waits for the device. On failure, or if stopped, `*maps` is NULL.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (size; an image whose shape does not fit its layout),
/// LOBE_ERROR_LIMIT (an image larger than the device allows), LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
LOBE_API lobe_result lobe_environment_maps_create(
    lobe_device *device, const lobe_environment_maps_parameters *parameters,
    lobe_environment_maps **maps);
/// Clears the pointer; NULL is allowed. The device is not destroyed.
LOBE_API void lobe_environment_maps_destroy(lobe_environment_maps **maps);

/// Replaces the environment with one of the same layout and extent (NULL: keeps it, for timing) and
/// rebuilds all maps. After a failure the maps have no content.
LOBE_API lobe_result lobe_environment_maps_update(lobe_environment_maps *maps,
                                                  const lobe_environment *environment);

typedef struct lobe_environment_maps_information {
    /// Texels along a face of level 0, and levels down to 1x1; 0 for a map that was not wanted.
    uint32_t width[LOBE_ENVIRONMENT_MAP_COUNT];
    uint32_t levels[LOBE_ENVIRONMENT_MAP_COUNT];
    double milliseconds; ///< device time of all submissions of the last creation or update
    uint32_t submissions;
    bool cached; ///< the filtered cubes come from the cache
    /// Passes of these submissions. "environment_reduction" is the plain MIP chain of the radiance,
    /// the baseline to compare the others with.
    const lobe_pass_time *passes;
    size_t pass_count;
} lobe_environment_maps_information;

/// Valid until the next update.
LOBE_API const lobe_environment_maps_information *
lobe_environment_maps_describe(const lobe_environment_maps *maps);

/// The concentration kappa of the lobe that a level of a filtered cube is filtered with, if level 0
/// has `width` texels along a face; twice that for LOBE_ENVIRONMENT_BETWEEN. Lobes of other
/// concentrations are interpolated between levels, or between the two cubes.
LOBE_API double lobe_environment_level_concentration(uint32_t width, uint32_t level);

/// Copies one face of one level to host memory: RGBA32_FLOAT, rows from top to bottom as in
/// Vulkan; free it with lobe_image_free. On failure `*image` is empty.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (no such map, level or face), ...
LOBE_API lobe_result lobe_environment_maps_read(lobe_environment_maps *maps,
                                                lobe_environment_map map, uint32_t level,
                                                uint32_t face, lobe_image *image);

#ifdef __cplusplus
}
#endif

#endif
