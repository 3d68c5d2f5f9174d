#include "passes/upload/transform.h"

#include <math.h>

double passes_transform_determinant(const float transform[16]) {
    const float *a = transform, *b = transform + 4, *c = transform + 8;
    return a[0] * ((double)b[1] * c[2] - (double)b[2] * c[1]) +
           a[1] * ((double)b[2] * c[0] - (double)b[0] * c[2]) +
           a[2] * ((double)b[0] * c[1] - (double)b[1] * c[0]);
}

static double dot(const float a[3], const float b[3]) {
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

bool passes_transform_keeps_angles(const float transform[16]) {
    // Columns of equal length at right angles.
    const float *x = transform, *y = transform + 4, *z = transform + 8;
    const double square = dot(x, x), slack = 1e-3 * square;
    return fabs(dot(y, y) - square) <= slack && fabs(dot(z, z) - square) <= slack &&
           fabs(dot(x, y)) <= slack && fabs(dot(y, z)) <= slack && fabs(dot(z, x)) <= slack;
}

double passes_transform_stretch(const float transform[16]) {
    const float *x = transform, *y = transform + 4, *z = transform + 8;
    return passes_transform_keeps_angles(transform) ? 1.001 * sqrt(dot(x, x))
                                                    : sqrt(dot(x, x) + dot(y, y) + dot(z, z));
}
