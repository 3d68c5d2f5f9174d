#ifndef SCENES_ENVIRONMENT_H
#define SCENES_ENVIRONMENT_H

#include <stdint.h>

#include <lobe/environment.h>
#include <lobe/host.h>
#include <lobe/result.h>

/// An environment without an image, of latitude and longitude, not turned, of intensity 1. Errors:
/// LOBE_ERROR_OUT_OF_MEMORY, with `*environment` NULL.
lobe_result scenes_environment_allocate(const char *name, const lobe_host *host,
                                        lobe_environment **environment);

/// What an image that was read needs to be an environment's: repairs it and halves it until it is
/// no larger than lobe needs (latitude and longitude of 8192, faces of 2048 texels) and
/// LOBE_ENVIRONMENT_MAXIMUM_EXTENT allows. The layout fits the image. Errors:
/// LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_environment_complete(lobe_environment *environment, const lobe_host *host);

#endif
