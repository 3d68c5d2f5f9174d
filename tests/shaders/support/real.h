#ifndef TESTS_SHADERS_SUPPORT_REAL_H
#define TESTS_SHADERS_SUPPORT_REAL_H

/// Real numbers of 256 bits (MPFR), written as expressions:
///   divide(one, subtract(one, exponential(x)))
/// Numbers live until release_reals(), at most REAL_MAXIMUM at a time; their memory is kept for the
/// next ones.

typedef const struct real_number *real;

enum { REAL_BITS = 256, REAL_MAXIMUM = 1 << 16 };

void release_reals(void);

real real_from(double value);
double to_double(real a);

real real_pi(void);
real add(real a, real b);
real subtract(real a, real b);
real multiply(real a, real b);
real divide(real a, real b);
real square(real a);
real negate(real a);
real power(real base, real exponent);
real exponential(real a);
real exponential_minus_one(real a);
real logarithm(real a);
real logarithm_of_one_plus(real a);
real square_root(real a);
real hyperbolic_cotangent(real a);
real complementary_error_function(real a);
/// Negative, zero or positive as a is below, at or above b.
int compare(real a, real b);

/// Three components from floats, exactly, and a vector made unit length.
typedef struct real_vector {
    real x, y, z;
} real_vector;

real_vector vector_from(const float v[3]);
real_vector unit_vector_from(const float v[3]);
real dot(real_vector a, real_vector b);

#endif
