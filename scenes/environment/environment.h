#ifndef SCENES_ENVIRONMENT_H
#define SCENES_ENVIRONMENT_H

#include <stdint.h>

#include <lobe/environment.h>
#include <lobe/host.h>
#include <lobe/result.h>

/// An environment without an image: latitude and longitude, identity rotation, intensity 1. On
/// failure (LOBE_ERROR_OUT_OF_MEMORY) `*environment` is NULL.
lobe_result scenes_environment_allocate(const char *name, const lobe_host *host,
                                        lobe_environment **environment);

/// Makes an image that was read suitable for an environment: repairs it, and halves it until it is
/// no larger than lobe needs (latitude and longitude 8192 texels wide, faces of 2048 texels) and
/// LOBE_ENVIRONMENT_MAXIMUM_EXTENT allows. The image must fit the layout. Errors:
/// LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_environment_complete(lobe_environment *environment, const lobe_host *host);

#endif
