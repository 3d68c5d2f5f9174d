#include "tests/reference/map/normal_map.h"

#include <math.h>

#include "tests/reference/vector.h"

void reference_decode_normal(const double texel[3], double scale, double normal[3]) {
    double largest = 0;
    for (int i = 0; i < 3; i++) {
        normal[i] = (2 * texel[i] - 1) * (i < 2 ? scale : 1);
        largest = isfinite(normal[i]) ? fmax(largest, fabs(normal[i])) : INFINITY;
    }
    if (largest < 1e-6 || isinf(largest)) {
        normal[0] = normal[1] = 0;
        normal[2] = 1;
    }
    reference_normalise(normal);
}
