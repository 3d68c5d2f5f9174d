#ifndef SCENES_ENVIRONMENT_REPAIR_H
#define SCENES_ENVIRONMENT_REPAIR_H

#include <lobe/environment.h>
#include <lobe/host.h>
#include <lobe/result.h>

/// Makes every number of the image finite and at least 0. Negative numbers become 0. NaN and
/// infinity become the mean of the finite numbers around them (of the eight neighbours on the same
/// face, negative ones counted as 0), or 0 if there are none. One warning counts the texels of each
/// kind. The empty parts of crosses silently become 0; alpha becomes 1. `image` is RGBA32_FLOAT and
/// fits the layout. Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_environment_repair(lobe_environment *environment, const lobe_host *host);

#endif
