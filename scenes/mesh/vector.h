#ifndef SCENES_MESH_VECTOR_H
#define SCENES_MESH_VECTOR_H

#include <math.h>
#include <stdbool.h>

/// Vectors of three doubles, so that positions near the limits of float can be multiplied without
/// overflow.
typedef struct vector3 {
    double x, y, z;
} vector3;

static inline vector3 vector3_load(const float v[3]) {
    return (vector3){v[0], v[1], v[2]};
}

static inline void vector3_store(vector3 v, float out[3]) {
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

static inline vector3 vector3_add(vector3 a, vector3 b) {
    return (vector3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline vector3 vector3_subtract(vector3 a, vector3 b) {
    return (vector3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline vector3 vector3_scale(vector3 a, double s) {
    return (vector3){a.x * s, a.y * s, a.z * s};
}

static inline double vector3_dot(vector3 a, vector3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vector3 vector3_cross(vector3 a, vector3 b) {
    return (vector3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A point transformed by a column-major affine transform.
static inline vector3 vector3_transform(const float m[16], vector3 p) {
    return (vector3){m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
                     m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                     m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
}

static inline double vector3_length(vector3 a) {
    return sqrt(vector3_dot(a, a));
}

/// Normalises `*a`. False, with `*a` unchanged, if it is no longer than `shortest` or not finite.
static inline bool vector3_normalise(vector3 *a, double shortest) {
    double length = vector3_length(*a);
    if (!(length > shortest) || !isfinite(length))
        return false;
    *a = vector3_scale(*a, 1 / length);
    return true;
}

#endif
