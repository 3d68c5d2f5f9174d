#include "tests/shaders/support/check.h"

#include <math.h>

#include "tests/engine/support/cmocka_all.h"

// The check closest to failing since the last report.
static double worst, worst_actual, worst_expected;

void check_close(const char *function, const harness_arguments *arguments, double actual,
                 double expected, double tolerance) {
    double error = fabs(actual - expected);
    if (!(error <= tolerance)) {
        const float *a = arguments->a, *b = arguments->b, *c = arguments->c;
        fail_msg("%s: %.9g instead of %.9g (off by %.3g, allowed %.3g) for "
                 "(%.9g %.9g %.9g %.9g) (%.9g %.9g %.9g %.9g) (%.9g %.9g %.9g %.9g)",
                 function, actual, expected, error, tolerance, a[0], a[1], a[2], a[3], b[0], b[1],
                 b[2], b[3], c[0], c[1], c[2], c[3]);
    }
    if (error > worst * tolerance) {
        worst = error / tolerance;
        worst_actual = actual;
        worst_expected = expected;
    }
}

void check_relative(const char *function, const harness_arguments *arguments, double actual,
                    double expected, double bound) {
    check_close(function, arguments, actual, expected, bound * fabs(expected) + FLOAT_SMALLEST);
}

void report_worst_error(const char *function) {
    print_message("# %s: off by at most %.2f of what is allowed (%.9g instead of %.9g)\n", function,
                  worst, worst_actual, worst_expected);
    worst = 0;
}
