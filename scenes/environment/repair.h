#ifndef SCENES_ENVIRONMENT_REPAIR_H
#define SCENES_ENVIRONMENT_REPAIR_H

#include <lobe/environment.h>
#include <lobe/host.h>
#include <lobe/result.h>

/// Makes every number of the image finite and at least 0: negative numbers become 0; one that is
/// NaN or infinite becomes the mean of the finite numbers around it (of the eight neighbours on the
/// same face, negative ones as 0), or 0 without any. One warning counts the texels of each kind.
/// The empty parts of crosses become 0, unsaid; alpha becomes 1. `image` is RGBA32_FLOAT and fits
/// the layout. Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_environment_repair(lobe_environment *environment, const lobe_host *host);

#endif
