#ifndef PASSES_ENVIRONMENT_ROTATION_H
#define PASSES_ENVIRONMENT_ROTATION_H

#include <lobe/environment.h>

/// Turns a direction (any vector) of the world into the environment's space; only the first three
/// numbers of `turned` are written.
static inline void environment_from_world(const lobe_environment *environment,
                                          const float direction[3], float turned[3]) {
    // The inverse of a rotation is its transpose.
    for (int column = 0; column < 3; ++column) {
        const float *axis = environment->world_from_environment[column];
        turned[column] = axis[0] * direction[0] + axis[1] * direction[1] + axis[2] * direction[2];
    }
}

#endif
