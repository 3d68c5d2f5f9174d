#ifndef TOOLS_BENCH_MEDIAN_H
#define TOOLS_BENCH_MEDIAN_H

#include <stddef.h>

/// Sorts `count` values, at least one; of an even number, the mean of the two in the middle.
double median(double *values, size_t count);

#endif
