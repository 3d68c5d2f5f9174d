#include "tests/shaders/support/real.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <mpfr.h>

struct real_number {
    mpfr_t value;
};

static struct real_number numbers[REAL_MAXIMUM];
static size_t initialised, used;

// Numbers stay initialised for the next expression.
void release_reals(void) {
    used = 0;
}

static struct real_number *new_real(void) {
    if (used == REAL_MAXIMUM) {
        fprintf(stderr, "more than %d reals: release_reals() is missing\n", REAL_MAXIMUM);
        abort();
    }
    if (used == initialised)
        mpfr_init2(numbers[initialised++].value, REAL_BITS);
    return &numbers[used++];
}

real real_from(double value) {
    struct real_number *result = new_real();
    mpfr_set_d(result->value, value, MPFR_RNDN);
    return result;
}

double to_double(real a) {
    return mpfr_get_d(a->value, MPFR_RNDN);
}

real real_pi(void) {
    struct real_number *result = new_real();
    mpfr_const_pi(result->value, MPFR_RNDN);
    return result;
}

// Of one and of two arguments, by MPFR's functions of the same meaning.
#define UNARY(name, function)                                                                      \
    real name(real a) {                                                                            \
        struct real_number *result = new_real();                                                   \
        function(result->value, a->value, MPFR_RNDN);                                              \
        return result;                                                                             \
    }
#define BINARY(name, function)                                                                     \
    real name(real a, real b) {                                                                    \
        struct real_number *result = new_real();                                                   \
        function(result->value, a->value, b->value, MPFR_RNDN);                                    \
        return result;                                                                             \
    }

BINARY(add, mpfr_add)
BINARY(subtract, mpfr_sub)
BINARY(multiply, mpfr_mul)
BINARY(divide, mpfr_div)
BINARY(power, mpfr_pow)
UNARY(square, mpfr_sqr)
UNARY(negate, mpfr_neg)
UNARY(exponential, mpfr_exp)
UNARY(exponential_minus_one, mpfr_expm1)
UNARY(logarithm, mpfr_log)
UNARY(logarithm_of_one_plus, mpfr_log1p)
UNARY(square_root, mpfr_sqrt)
UNARY(hyperbolic_cotangent, mpfr_coth)
UNARY(complementary_error_function, mpfr_erfc)

int compare(real a, real b) {
    return mpfr_cmp(a->value, b->value);
}

real_vector vector_from(const float v[3]) {
    return (real_vector){real_from(v[0]), real_from(v[1]), real_from(v[2])};
}

real_vector unit_vector_from(const float v[3]) {
    real_vector vector = vector_from(v);
    real length = square_root(dot(vector, vector));
    return (real_vector){divide(vector.x, length), divide(vector.y, length),
                         divide(vector.z, length)};
}

real dot(real_vector a, real_vector b) {
    return add(add(multiply(a.x, b.x), multiply(a.y, b.y)), multiply(a.z, b.z));
}
