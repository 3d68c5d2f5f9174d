#ifndef SCENES_ENVIRONMENT_HALVE_H
#define SCENES_ENVIRONMENT_HALVE_H

#include <stdbool.h>

#include <lobe/environment.h>

/// Whether the faces (or the latitude and longitude image) are larger than one texel, so that they
/// can be halved.
bool scenes_environment_can_be_halved(const lobe_environment *environment);

/// Halves the extent of each face, or of the latitude and longitude image, in place (odd extents
/// are rounded down, to at least 1). Each new texel is the mean of the area it covers, weighted by
/// solid angle, so that the light from the texel's part of the sphere is unchanged.
void scenes_environment_halve(lobe_environment *environment);

#endif
