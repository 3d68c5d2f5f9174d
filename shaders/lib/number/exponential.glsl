#ifndef LIB_EXPONENTIAL_GLSL
#define LIB_EXPONENTIAL_GLSL

// exp(x) - 1 and log(1 + x) where subtracting or adding 1 would cancel.

// exp(x) - 1 = 2 tanh(x/2) / (1 - tanh(x/2)).
// Near zero: the continued fraction of the hyperbolic tangent, cut after four terms.
// (Lambert, 1761; Abramowitz and Stegun, 1964, Handbook of Mathematical Functions, Eq. 4.5.70.)
//   tanh y = y/(1 + y^2/(3 + y^2/(5 + y^2/(7 + y^2/9)))) = y (945 + 105 y^2 + y^4)
//                                                        / (945 + 420 y^2 + 15 y^4)
// The rest is below 1e-11 for |y| <= 1/2. Beyond, exp(x) - 1 no longer cancels.
float expm1(float x) {
    float y = 0.5 * x;
    float square = y * y;
    float numerator = y * (945.0 + square * (105.0 + square));
    float denominator = 945.0 + square * (420.0 + 15.0 * square);
    return abs(x) < 1.0 ? 2.0 * numerator / (denominator - numerator) : exp(x) - 1.0;
}

// log(1 + x) = 2 atanh(z), z = x / (2 + x).
// atanh(z)/z is fitted on z^2 in [0, 1/9], which is x in [-1/2, 1], with the smallest maximum
// relative error, 2.6e-8; the first coefficient is kept at 1 so that small x come out exact.
// Valid for x > -1.
float log1p(float x) {
    float z = x / (2.0 + x);
    float square = z * z;
    float series =
        1.0 + square * (0.33333324 +
                        square * (0.20002309 + square * (0.1413433 + square * 0.13408456)));
    return x >= -0.5 && x <= 1.0 ? 2.0 * z * series : log(1.0 + x);
}

#endif
