#ifndef SCENES_ENVIRONMENT_HALVE_H
#define SCENES_ENVIRONMENT_HALVE_H

#include <stdbool.h>

#include <lobe/environment.h>

/// Whether faces (or latitude and longitude) are more than one texel large, so that they can be
/// halved.
bool scenes_environment_can_be_halved(const lobe_environment *environment);

/// Halves the extent of each face, or of latitude and longitude (odd ones are rounded down, at
/// least 1), in place. Each new texel is the mean of what it covers, weighed by solid angles, so
/// that the light from the texel's part of the sphere stays as it was.
void scenes_environment_halve(lobe_environment *environment);

#endif
