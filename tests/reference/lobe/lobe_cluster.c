#include "tests/reference/lobe/lobe_cluster.h"

#include <math.h>

// The device's constant is a float.
static const double latitude_split = 0.978f;

static uint32_t cluster_of_paper(const double direction[3]) {
    // The longitude in quarters of a turn, [0, 4).
    double longitude = atan2(direction[1], direction[0]) / (M_PI / 2);
    uint32_t quarter = (uint32_t)floor(longitude < 0 ? longitude + 4 : longitude) % 4;
    return 2 * quarter + (acos(fmin(direction[2], 1)) > M_PI / 4 ? 1 : 0);
}

uint32_t reference_cluster_of(const double direction[3], bool paper) {
    double x = direction[0], y = direction[1];
    uint32_t sector;
    if (paper)
        return cluster_of_paper(direction);
    if (fabs(x) >= fabs(y))
        sector = x < 0 ? 2 : 0;
    else
        sector = y < 0 ? 3 : 1;
    return 2 * sector + (direction[2] < latitude_split ? 1 : 0);
}
