#include "tests/reference/lobe/lobe_cluster.h"

#include <math.h>

// The device's constant is a float.
static const double latitude_split = 0.978f;

uint32_t reference_cluster_of(const double direction[3]) {
    double x = direction[0], y = direction[1];
    uint32_t sector;
    if (fabs(x) >= fabs(y))
        sector = x < 0 ? 2 : 0;
    else
        sector = y < 0 ? 3 : 1;
    return 2 * sector + (direction[2] < latitude_split ? 1 : 0);
}
