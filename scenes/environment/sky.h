#ifndef SCENES_ENVIRONMENT_SKY_H
#define SCENES_ENVIRONMENT_SKY_H

#include <stdint.h>

#include <lobe/environment.h>
#include <lobe/host.h>
#include <lobe/result.h>

#include "scenes/mesh/vector.h"

#define ENVIRONMENT_SKY_WIDTH  1024
#define ENVIRONMENT_SKY_HEIGHT 512

/// The environment "sky": a clear sky with a sun 40 degrees high, to the left behind a viewer who
/// looks along -Z; grey ground below the horizon. A white level surface under it has a luminance of
/// 1. Latitude and longitude of any size. Errors: LOBE_ERROR_LIMIT, _OUT_OF_MEMORY.
lobe_result scenes_environment_sky(uint32_t width, uint32_t height, const lobe_host *host,
                                   lobe_environment **environment);

/// Adds a disc of this angular radius (radians) around a unit direction, which gives this
/// irradiance to a surface that faces it. No light is lost however few texels the disc covers: the
/// sum of radiance times solid angle grows by `irradiance`.
void scenes_environment_add_disc(lobe_environment *environment, vector3 direction, double radius,
                                 const double irradiance[3]);

#endif
