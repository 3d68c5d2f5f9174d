#include "tests/reference/lobe/normal_variance.h"

#include <math.h>

double reference_variance_of_mean_normal(double mean_length) {
    return (1 - mean_length) / mean_length;
}

double reference_widened_parameter(lobe_distribution distribution, double parameter,
                                   double variance) {
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG || distribution == LOBE_DISTRIBUTION_VMF)
        return parameter / (1 + parameter * variance);
    return fmin(sqrt(parameter * parameter + 2 * variance), fmax(parameter, 1));
}
