#include "tests/reference/lobe/dispersion.h"

#include <math.h>

double reference_dispersion(double mean_complement, double resultant_complement) {
    double base = fmax(mean_complement, 1e-6); // that of the sharpest lobe
    return fmax(resultant_complement - base, 0) / base;
}

double reference_transition(double measure, double threshold, double half_width) {
    if (half_width <= 0)
        return measure >= threshold ? 1 : 0;
    double t = (measure - (threshold - half_width)) / (2 * half_width);
    t = fmin(fmax(t, 0), 1);
    return 3 * t * t - 2 * t * t * t;
}
