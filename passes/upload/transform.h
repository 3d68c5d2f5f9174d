#ifndef PASSES_UPLOAD_TRANSFORM_H
#define PASSES_UPLOAD_TRANSFORM_H

#include <stdbool.h>

/// What follows from an instance's transform (column-major, affine). Hosts change transforms
/// between frames without announcing it, so nothing of this is kept.

/// In double precision: products of three elements must be in range at any scale. It is negative if
/// the transform mirrors.
double passes_transform_determinant(const float transform[16]);

/// Whether the linear part is a rotation or reflection times a uniform scale, so that directions of
/// the mesh can be rotated into the world's.
bool passes_transform_keeps_angles(const float transform[16]);

/// The factor by which the linear part stretches lengths; where they differ, a bound (its Frobenius
/// norm).
double passes_transform_stretch(const float transform[16]);

#endif
