#ifndef TESTS_REFERENCE_VECTOR_H
#define TESTS_REFERENCE_VECTOR_H

#include <math.h>

/// Vectors of three doubles.

static inline double reference_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double reference_length(const double v[3]) {
    return sqrt(reference_dot(v, v));
}

/// v divided by its length, which must not be zero.
static inline void reference_normalise(double v[3]) {
    double length = reference_length(v);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/// |a - b|^2, which for unit vectors is 2 (1 - cos) of the angle between them.
static inline double reference_distance_squared(const double a[3], const double b[3]) {
    const double difference[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return reference_dot(difference, difference);
}

#endif
