#include "tests/reference/lobe/von_mises_fisher.h"

#include <math.h>

#include "tests/reference/vector.h"

double reference_von_mises_fisher(const double direction[3], const double mean[3], double kappa) {
    // kappa / (4 pi sinh kappa) exp(kappa cos), with 1 - cos from the difference.
    double exponent = -0.5 * kappa * reference_distance_squared(direction, mean);
    double peak = kappa > 0 ? kappa / (-2 * M_PI * expm1(-2 * kappa)) : 0.25 / M_PI;
    return peak * exp(exponent);
}

double reference_mean_resultant_length(double kappa) {
    // Below 0.01 the difference of two poles loses its digits; the Taylor series has them.
    if (kappa < 0.01)
        return kappa / 3 - pow(kappa, 3) / 45 + 2 * pow(kappa, 5) / 945 - pow(kappa, 7) / 4725;
    long double k = kappa;
    return (double)(1 / tanhl(k) - 1 / k);
}

double reference_mean_resultant_complement(double kappa) {
    if (kappa < 0.01)
        return 1 - reference_mean_resultant_length(kappa);
    long double k = kappa;
    return (double)(1 / k - 2 / expm1l(2 * k));
}

double reference_concentration_from_complement(double complement) {
    // 1 - R falls with kappa, from 1 at 0, and is at most 1/kappa.
    double low = 0, high = 1 / complement;
    for (int i = 0; i < 200 && low < high; i++) {
        double middle = 0.5 * (low + high);
        if (reference_mean_resultant_complement(middle) > complement)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}
