#include "tests/shaders/support/exact.h"

real exact_resultant_complement(real kappa) {
    return subtract(real_from(1), exact_resultant(kappa));
}

real exact_resultant(real kappa) {
    if (compare(kappa, real_from(0)) == 0)
        return kappa;
    return subtract(hyperbolic_cotangent(kappa), divide(real_from(1), kappa));
}

// 1/kappa^2 - 1/sinh^2 kappa, with 1/sinh^2 = coth^2 - 1.
static real resultant_slope(real kappa) {
    real coth = hyperbolic_cotangent(kappa);
    return add(subtract(divide(real_from(1), square(kappa)), square(coth)), real_from(1));
}

real exact_concentration(real resultant) {
    real one = real_from(1), three = real_from(3);
    if (compare(resultant, real_from(0)) == 0)
        return resultant;
    // Newton's method from Xu et al. 2017, Eq. 8, within 5 % of the root: five steps are enough
    // for twice the digits of a double.
    real length_squared = square(resultant);
    real kappa =
        divide(multiply(resultant, subtract(three, length_squared)), subtract(one, length_squared));
    for (int step = 0; step < 6; step++) {
        real error = subtract(exact_resultant(kappa), resultant);
        kappa = subtract(kappa, divide(error, resultant_slope(kappa)));
    }
    return kappa;
}

real exact_von_mises_fisher_peak(real kappa) {
    real zero = real_from(0);
    if (compare(kappa, zero) == 0)
        return divide(real_from(0.25), real_pi());
    // kappa / (2 pi (1 - exp(-2 kappa)))
    real below = subtract(zero, exponential_minus_one(multiply(real_from(-2), kappa)));
    return divide(kappa, multiply(multiply(real_from(2), real_pi()), below));
}

real exact_von_mises_fisher_exponent(const float direction[3], const float mean[3], double kappa) {
    real cosine = dot(unit_vector_from(direction), unit_vector_from(mean));
    return multiply(real_from(kappa), subtract(cosine, real_from(1)));
}

real exact_von_mises_fisher(const float direction[3], const float mean[3], double kappa) {
    return multiply(exact_von_mises_fisher_peak(real_from(kappa)),
                    exponential(exact_von_mises_fisher_exponent(direction, mean, kappa)));
}
