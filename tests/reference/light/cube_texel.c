#include "tests/reference/light/cube_texel.h"

#include <math.h>

#include "tests/reference/vector.h"

// Khronos Group, 2023, Vulkan 1.3 Specification, "Cube Map Face Selection": for each face the axis
// and sign of s, of t and of the major axis.
static const struct {
    int axis, sign;
} selection[6][3] = {
    {{2, -1}, {1, -1}, {0, 1}}, {{2, 1}, {1, -1}, {0, -1}}, {{0, 1}, {2, 1}, {1, 1}},
    {{0, 1}, {2, -1}, {1, -1}}, {{0, 1}, {1, -1}, {2, 1}},  {{0, -1}, {1, -1}, {2, -1}},
};

int reference_cube_face(const double direction[3], double position[2]) {
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(direction[i]) >= fabs(direction[axis]))
            axis = i;
    int face = 2 * axis + (direction[axis] < 0);
    for (int i = 0; i < 2; i++)
        position[i] =
            (selection[face][i].sign * direction[selection[face][i].axis] / fabs(direction[axis]) +
             1) /
            2;
    return face;
}

void reference_cube_texel_direction(int face, int x, int y, int size, double direction[3]) {
    const double coordinates[3] = {(2.0 * x + 1) / size - 1, (2.0 * y + 1) / size - 1, 1};
    for (int i = 0; i < 3; i++)
        direction[selection[face][i].axis] = selection[face][i].sign * coordinates[i];
    reference_normalise(direction);
}

// The square from the face's centre to (x, y). long double: a texel is a difference of four.
static long double corner_solid_angle(long double x, long double y) {
    return atan2l(x * y, sqrtl(1 + x * x + y * y));
}

/// Steradians of the rectangle between two corners of a face, coordinates in [-1, 1].
static double solid_angle(const double low[2], const double high[2]) {
    return (double)(corner_solid_angle(high[0], high[1]) - corner_solid_angle(low[0], high[1]) -
                    corner_solid_angle(high[0], low[1]) + corner_solid_angle(low[0], low[1]));
}

double reference_cube_texel_solid_angle(int x, int y, int size) {
    const double low[2] = {2.0 * x / size - 1, 2.0 * y / size - 1};
    const double high[2] = {2.0 * (x + 1) / size - 1, 2.0 * (y + 1) / size - 1};
    return solid_angle(low, high);
}
