#ifndef TESTS_SHADERS_SUPPORT_CHECK_H
#define TESTS_SHADERS_SUPPORT_CHECK_H

#include "tests/shaders/support/harness.h"

/// Half a unit in the last place of float32, relative: the error of one rounding.
#define FLOAT_ROUNDING 0x1p-24

/// Smallest normal float32: below it a device may flush to zero.
#define FLOAT_SMALLEST 0x1p-126

/// Fails unless |actual - expected| <= tolerance, neither being NaN, and names the function and its
/// arguments. Keeps the worst quotient of error and tolerance.
void check_close(const char *function, const harness_arguments *arguments, double actual,
                 double expected, double tolerance);

/// The same with a relative bound, and an absolute one of FLOAT_SMALLEST.
void check_relative(const char *function, const harness_arguments *arguments, double actual,
                    double expected, double bound);

/// Prints the worst error since the last report, relative to the allowed one.
void report_worst_error(const char *function);

#endif
