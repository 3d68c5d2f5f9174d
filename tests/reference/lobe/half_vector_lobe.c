#include "tests/reference/lobe/half_vector_lobe.h"

#include <math.h>

#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/reference/vector.h"

static double blinn_phong(const double half_vector[3], const double mean[3], double exponent) {
    double cosine = reference_dot(half_vector, mean);
    return cosine > 0 ? (exponent + 1) / (2 * M_PI) * pow(cosine, exponent) : 0;
}

double reference_half_vector_lobe(lobe_distribution distribution, const double half_vector[3],
                                  const double mean[3], double parameter) {
    return distribution == LOBE_DISTRIBUTION_BLINN_PHONG
               ? blinn_phong(half_vector, mean, parameter)
               : reference_von_mises_fisher(half_vector, mean, parameter);
}

void reference_rotate_from_pole(const double normal[3], const double local[3], double rotated[3]) {
    // Rodrigues 1840: v' = v cos + (k x v) sin + k <k, v> (1 - cos), about the unit axis
    // k = pole x normal / |...| in the equator.
    double sine = hypot(normal[0], normal[1]);
    double cosine = normal[2];
    double axis[2] = {1, 0};
    if (sine > 0) {
        axis[0] = -normal[1] / sine;
        axis[1] = normal[0] / sine;
    }
    const double cross[3] = {axis[1] * local[2], -axis[0] * local[2],
                             axis[0] * local[1] - axis[1] * local[0]};
    double along = (axis[0] * local[0] + axis[1] * local[1]) * (1 - cosine);
    rotated[0] = local[0] * cosine + cross[0] * sine + axis[0] * along;
    rotated[1] = local[1] * cosine + cross[1] * sine + axis[1] * along;
    rotated[2] = local[2] * cosine + cross[2] * sine;
}
