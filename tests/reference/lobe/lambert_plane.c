#include "tests/reference/lobe/lambert_plane.h"

#include <math.h>

#include "tests/reference/lobe/half_vector_lobe.h"

void reference_plane_from_direction(const double direction[3], double place[2]) {
    double sine = hypot(direction[0], direction[1]);
    double radius = 2 * sin(0.5 * atan2(sine, direction[2]));
    for (int i = 0; i < 2; i++)
        place[i] = sine > 0 ? direction[i] / sine * radius : 0;
}

void reference_direction_from_plane(const double place[2], double direction[3]) {
    double radius = hypot(place[0], place[1]), angle = 2 * asin(fmin(0.5 * radius, 1));
    for (int i = 0; i < 2; i++)
        direction[i] = radius > 0 ? place[i] / radius * sin(angle) : 0;
    direction[2] = cos(angle);
}

/// Place of the direction that is `step` radians from `axis` towards `side`.
static void place_beside(const double axis[3], const double side[3], double step, double place[2]) {
    double direction[3];
    for (int i = 0; i < 3; i++)
        direction[i] = cos(step) * axis[i] + sin(step) * side[i];
    reference_plane_from_direction(direction, place);
}

void reference_plane_distortion(const double place[2], double distortion[3]) {
    static const double step = 1e-5;
    double axis[3];
    reference_direction_from_plane(place, axis);
    distortion[0] = distortion[1] = distortion[2] = 0;
    for (int i = 0; i < 2; i++) {
        const double local[3] = {i == 0, i == 1, 0};
        double side[3], ahead[2], behind[2];
        reference_rotate_from_pole(axis, local, side);
        place_beside(axis, side, step, ahead);
        place_beside(axis, side, -step, behind);
        double x = (ahead[0] - behind[0]) / (2 * step), y = (ahead[1] - behind[1]) / (2 * step);
        distortion[0] += x * x;
        distortion[1] += y * y;
        distortion[2] += x * y;
    }
}
