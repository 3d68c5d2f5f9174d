#ifndef SCENES_BUILTIN_NOISE_H
#define SCENES_BUILTIN_NOISE_H

#include <stdint.h>

/// Smooth noise over the plane that repeats after `period` units in both directions; its features
/// are about one unit wide. Returns a height in about [-0.7, 0.7] with mean 0; `slope`, unless
/// NULL, receives its exact derivatives along x and y. Negative coordinates are allowed.
double scenes_noise_gradient(double x, double y, uint32_t period, uint32_t seed, double slope[2]);

#endif
