#ifndef SCENES_ANIMATION_TRANSFORM_H
#define SCENES_ANIMATION_TRANSFORM_H

#include <stdbool.h>

/// Column-major affine transforms in double precision.

/// out = a b. `out` is neither of them.
void scenes_transform_multiply(const double a[16], const double b[16], double out[16]);

/// The columns of the rotation given by a quaternion (x, y, z, w) of any length. False if its
/// length is 0.
bool scenes_transform_rotation(const double quaternion[4], double columns[3][3]);

/// T R S: glTF 2.0, section 3.5.3. False if the rotation has no length.
bool scenes_transform_compose(const double translation[3], const double rotation[4],
                              const double scale[3], double out[16]);

/// Whether the last row is (0, 0, 0, 1), but for rounding.
bool scenes_transform_is_affine(const double m[16]);

/// Whether squares of all elements are finite in single precision. NaN is not.
bool scenes_transform_is_in_range(const double m[16]);

/// The sign of the determinant; 0 if the three axes span practically no volume.
int scenes_transform_handedness(const double m[16]);

/// Rounds to single precision, with a last row of exactly (0, 0, 0, 1).
void scenes_transform_store(const double m[16], float out[16]);

#endif
