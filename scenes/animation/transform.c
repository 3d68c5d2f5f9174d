#include "scenes/animation/transform.h"

#include <math.h>
#include <string.h>

void scenes_transform_multiply(const double a[16], const double b[16], double out[16]) {
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
    }
}

bool scenes_transform_rotation(const double q[4], double columns[3][3]) {
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 1e-6) || !isfinite(length))
        return false;
    double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    const double rotation[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
        {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
        {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
    };
    memcpy(columns, rotation, sizeof rotation);
    return true;
}

bool scenes_transform_compose(const double translation[3], const double rotation[4],
                              const double scale[3], double out[16]) {
    double columns[3][3];
    if (!scenes_transform_rotation(rotation, columns))
        return false;
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            out[4 * column + row] = columns[column][row] * scale[column];
        out[4 * column + 3] = 0;
        out[12 + column] = translation[column];
    }
    out[15] = 1;
    return true;
}

bool scenes_transform_is_affine(const double m[16]) {
    return fabs(m[3]) < 1e-6 && fabs(m[7]) < 1e-6 && fabs(m[11]) < 1e-6 && fabs(m[15] - 1) < 1e-6;
}

bool scenes_transform_is_in_range(const double m[16]) {
    for (int i = 0; i < 16; i++) {
        if (!(fabs(m[i]) <= 1e18))
            return false;
    }
    return true;
}

int scenes_transform_handedness(const double m[16]) {
    double determinant = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
                         m[8] * (m[1] * m[6] - m[2] * m[5]);
    double volume = 1;
    for (int column = 0; column < 3; column++) {
        const double *c = m + 4 * column;
        volume *= sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    }
    if (!(fabs(determinant) > 1e-9 * volume))
        return 0;
    return determinant < 0 ? -1 : 1;
}

void scenes_transform_store(const double m[16], float out[16]) {
    for (int i = 0; i < 16; i++)
        out[i] = (float)m[i];
    out[3] = out[7] = out[11] = 0;
    out[15] = 1;
}
