#include "passes/maps/mean_resultant_length.h"

#include <math.h>

double passes_mean_resultant_length(double kappa) {
    // Where the difference cancels, the first term of its series.
    return kappa < 1e-3 ? kappa / 3 : 1 / tanh(kappa) - 1 / kappa;
}
