#ifndef TESTS_SHADERS_SUPPORT_SAMPLES_H
#define TESTS_SHADERS_SUPPORT_SAMPLES_H

#include <stddef.h>
#include <stdint.h>

/// Arguments for functions under test, always the same.

/// Next number in [0, 1). Any state will do as a start.
double random_number(uint64_t *state);
double scenes_random_between(uint64_t *state, double low, double high);

/// A unit direction, evenly distributed over the sphere, rounded to float.
void random_direction(uint64_t *state, float direction[3]);

/// The unit direction at `angle` from `mean` and `azimuth` about it, in radians, rounded to float.
void direction_at(const float mean[3], double angle, double azimuth, float direction[3]);

/// The i-th of `count` numbers from low to high, both included, in equal quotients.
double geometric(double low, double high, size_t i, size_t count);

#endif
