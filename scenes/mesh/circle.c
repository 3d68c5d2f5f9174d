#include "scenes/mesh/circle.h"

#include <math.h>

// Taylor series, enough for double precision within an eighth of a turn.
static double sine(double x) {
    double s = x * x, sum = 0;
    for (int n = 17; n > 1; n -= 2)
        sum = -s / (n * (n - 1)) * (1 + sum);
    return x * (1 + sum);
}

static double cosine(double x) {
    double s = x * x, sum = 0;
    for (int n = 18; n > 0; n -= 2)
        sum = -s / (n * (n - 1)) * (1 + sum);
    return 1 + sum;
}

void scenes_circle_point(double turns, double point[2]) {
    double quarters = floor(turns * 4 + 0.5);
    double angle = (turns - quarters / 4) * 6.283185307179586;
    double x = cosine(angle), y = sine(angle);
    switch ((int)(quarters - floor(quarters / 4) * 4)) {
    case 0:
        point[0] = x, point[1] = y;
        break;
    case 1:
        point[0] = -y, point[1] = x;
        break;
    case 2:
        point[0] = -x, point[1] = -y;
        break;
    default:
        point[0] = y, point[1] = -x;
    }
}
